// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <utility>

#include "unit/this_system.h"

namespace lamp::test {

Variable::Variable(std::string name, const std::string& value) : name_(std::move(name)) {
  if (const char* before = std::getenv(name_.c_str()); before != nullptr) before_ = before;
  set(name_, value);
}

Variable::~Variable() { set(name_, before_.value_or("")); }  // an empty one is none

void Variable::set(const std::string& name, const std::string& value) { _putenv_s(name.c_str(), value.c_str()); }

FileSizeLimit::FileSizeLimit(std::uint64_t /*bytes*/) {}

FileSizeLimit::~FileSizeLimit() = default;

bool FileSizeLimit::is_there() { return false; }

bool has_links() { return false; }

bool make_pipe(const std::filesystem::path& /*file*/) { return false; }

}  // namespace lamp::test
