// Starts a process whose output goes into memory.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "error.h"
#include "system/run_program.h"
#include "system/signals_posix.h"

namespace lamp::app {
namespace {

[[noreturn]] void fail(std::string_view program, int error_number) {
  throw Error(fmt::format("{}: cannot be started: {}", program, std::generic_category().message(error_number)));
}

/// A file without a name, for the output of a child.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& program) : descriptor_(memfd_create("output", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(program, errno);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string text() const {
    std::string text;
    std::array<char, 4096> block{};
    lseek(descriptor_, 0, SEEK_SET);
    for (ssize_t count = 0; (count = read(descriptor_, block.data(), block.size())) > 0;)
      text.append(block.data(), static_cast<std::size_t>(count));
    return text;
  }

 private:
  int descriptor_;
};

}  // namespace

ProgramResult run_program(std::vector<std::string> words) {
  const MemoryFile out(words.front());
  const MemoryFile err(words.front());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  restore_signals(attributes);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) fail(words.front(), failed);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return {.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0, .out = out.text(), .err = err.text()};
}

}  // namespace lamp::app
