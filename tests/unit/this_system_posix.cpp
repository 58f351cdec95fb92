// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <utility>

#include "unit/this_system.h"

namespace lamp::test {

Variable::Variable(std::string name, const std::string& value) : name_(std::move(name)) {
  if (const char* before = std::getenv(name_.c_str()); before != nullptr) before_ = before;
  set(name_, value);
}

Variable::~Variable() { before_ ? set(name_, *before_) : static_cast<void>(unsetenv(name_.c_str())); }

void Variable::set(const std::string& name, const std::string& value) { setenv(name.c_str(), value.c_str(), 1); }

FileSizeLimit::FileSizeLimit(std::uint64_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
  rlimit limit{};
  EXPECT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  before_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

FileSizeLimit::~FileSizeLimit() {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = before_;
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler_);
}

bool FileSizeLimit::is_there() { return true; }

bool has_links() { return true; }

bool make_pipe(const std::filesystem::path& file) { return mkfifo(file.c_str(), 0600) == 0; }

}  // namespace lamp::test
