// Text of unknown origin (names in files, paths, what libraries say) as a terminal may show it.
// Based on: RFC 3629 (UTF-8); ECMA-48 (control characters).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace lamp::app {

/// On one line: control characters and bytes that are no UTF-8 are written as escapes (\n, \x1b).
[[nodiscard]] std::string printable(std::string_view text);

/// Printable, and where it is longer than a message should be without its middle: what is wrong stands in front, what
/// was expected at the end.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace lamp::app
