// The commands of `lamp`: each adds itself to the command line and returns its exit code.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "error.h"

namespace CLI {
class App;
}

namespace lamp::app {

/// What to do when a command was chosen.
using Run = std::function<Exit()>;

[[nodiscard]] Run add_render(CLI::App& app);
[[nodiscard]] Run add_verify(CLI::App& app);
[[nodiscard]] Run add_compare(CLI::App& app);
[[nodiscard]] Run add_capture(CLI::App& app);
[[nodiscard]] Run add_probe(CLI::App& app);
/// `arguments`: the whole command line, for the record of how results were made.
[[nodiscard]] Run add_bench(CLI::App& app, std::span<char* const> arguments);
[[nodiscard]] Run add_report(CLI::App& app);
[[nodiscard]] Run add_info(CLI::App& app);
[[nodiscard]] Run add_list(CLI::App& app);
[[nodiscard]] Run add_completion(CLI::App& app);
[[nodiscard]] Run add_help(CLI::App& app);

}  // namespace lamp::app
