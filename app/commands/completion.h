// What may stand at the end of a command line that is being typed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace lamp::app {

/// The words that may take the place of the line's last one, which may be empty; none: a file's name, or anything.
/// `line` begins with the program's name. A word that ends in '=' or ':' goes on.
[[nodiscard]] std::vector<std::string> completions(const CLI::App& app, std::string_view line);

}  // namespace lamp::app
