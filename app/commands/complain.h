// Where errors of a program end: one line on stderr and an exit code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

#include "error.h"

namespace lamp::app {

/// Says why, behind the program's name. Returns `exit`.
Exit complain(std::string_view program, std::string_view why, Exit exit);

/// What `run` returns; whatever goes wrong in it is complained about. Interrupted passes.
[[nodiscard]] Exit run_or_complain(std::string_view program, const std::function<Exit()>& run);

}  // namespace lamp::app
