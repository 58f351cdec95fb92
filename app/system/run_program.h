// Runs another program and waits for it.
// Promise: signals end `lamp` meanwhile as at any other time. (The standard library, while it waits for a program,
// ignores SIGINT.)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace lamp::app {

struct ProgramResult {
  bool succeeded = false;  ///< it ended by itself, with exit code 0
  std::string out;         ///< what it wrote to stdout
  std::string err;         ///< and to stderr
};

/// `words`: the program, looked for in PATH, and its arguments. Throws Error when it cannot be started.
[[nodiscard]] ProgramResult run_program(std::vector<std::string> words);

}  // namespace lamp::app
