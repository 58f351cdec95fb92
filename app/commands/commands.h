// The commands of `lamp`: each adds itself to the command line and returns its exit code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "error.h"

namespace lamp::app {

/// What to do when a command was chosen.
using Run = std::function<Exit()>;

[[nodiscard]] Run add_render(CLI::App& app);
[[nodiscard]] Run add_verify(CLI::App& app);
[[nodiscard]] Run add_compare(CLI::App& app);
[[nodiscard]] Run add_capture(CLI::App& app);
[[nodiscard]] Run add_list(CLI::App& app);

}  // namespace lamp::app
