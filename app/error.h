// The one exception of the tools: thrown where bad input is found, caught once in main.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "files/printable.h"
#include "lamplight/error.h"

namespace lamp::app {

/// Exit codes of `lamp`. `unchecked`: no check failed, but one could not be made.
enum class Exit : int { done = 0, check_failed = 1, bad_input = 2, no_device = 3, unchecked = 4 };

/// One line, printable and not too long: what, where, what was expected ("scene.gltf: light 3: range must be > 0, got
/// -1").
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& line, Exit exit = Exit::bad_input)
      : std::runtime_error(one_line(line)), exit_(exit) {}
  explicit Error(const lamp::Error& error, Exit exit = Exit::bad_input) : Error(error.text(), exit) {}
  [[nodiscard]] Exit exit() const { return exit_; }

 private:
  Exit exit_;
};

}  // namespace lamp::app
