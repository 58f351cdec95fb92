// Temporaries go before a signal ends the program; a StopRequest takes the first one.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "system/signals.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

/// Its folder is none of those that it tests: a child process that is ended would remove it.
class Signals : public ::testing::Test {
 protected:
  Signals() {
    std::string name = fs::temp_directory_path() / "signals-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~Signals() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::size_t entries() const {
    const fs::recursive_directory_iterator all(folder_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

 private:
  fs::path folder_;
};

/// Does that in a child process; the signal that ended it.
int signal_that_ended(const std::function<void()>& what) {
  const pid_t child = fork();
  if (child == 0) {
    for (const int ended_by : {SIGHUP, SIGINT, SIGTERM}) std::signal(ended_by, SIG_DFL);  // nohup ignores one
    watch_signals();
    what();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

/// Sends this process a signal, and waits for its end.
[[noreturn]] void end_by(int signal) {
  kill(getpid(), signal);
  for (;;) pause();
}

TEST_F(Signals, EndTheProgramAfterTemporaries) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    EXPECT_EQ(signal, signal_that_ended([&] {
                const NewFolders folders(path("a/b"));
                const Temporary file(Temporary::Removal::everything, [&] {
                  std::ofstream(path("a/b/file")) << "new";
                  return path("a/b/file");
                });
                const Temporary folder(Temporary::Removal::everything, [&] {
                  fs::create_directory(path("folder"));
                  return path("folder");
                });
                end_by(signal);
              }));
    EXPECT_EQ(entries(), 0U);
  }
}

TEST_F(Signals, AStopRequestTakesTheFirstSignal) {
  const auto ask = [&](bool again) {
    const StopRequest stop;
    kill(getpid(), SIGTERM);
    kill(getpid(), SIGTERM);  // a shell may send it twice
    while (StopRequest::signal() != SIGTERM) usleep(1000);
    usleep(1'100'000);
    if (again) end_by(SIGTERM);
  };
  EXPECT_EQ(signal_that_ended([&] { ask(false); }), 0);
  EXPECT_EQ(signal_that_ended([&] { ask(true); }), SIGTERM);
}

}  // namespace
}  // namespace lamp::app
