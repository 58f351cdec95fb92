// The standard streams as the system has them: open or closed, a terminal or a file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

namespace lamp::app {

/// Puts something in place of closed standard streams, so that no file that is opened later takes their numbers and
/// receives what is printed. Writing to them is still an error. On Windows, whose streams have no such numbers: what
/// is printed arrives as it is, in UTF-8. To be called first of all.
void open_standard_streams();

/// Letters that fit into a line of stdout's terminal; nothing: it is none.
[[nodiscard]] std::optional<std::size_t> terminal_width();

[[nodiscard]] bool stderr_is_terminal();

}  // namespace lamp::app
