// What all commands share of the command line: checks of numbers, and one line for what cannot be parsed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>

#include "error.h"

namespace lamp::app {

/// Accepts the decimal digits of a whole number from `min` to `max`; no sign, no other base.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t min, std::uint64_t max);

/// One line that names the command, option or argument that was not understood and, for a name, the nearest there are.
[[nodiscard]] Error parse_error(const CLI::App& app, const CLI::ParseError& error);

/// The text with line breaks and other control characters written as escapes, so that it stays one line.
[[nodiscard]] std::string escaped_line(std::string_view text);

}  // namespace lamp::app
