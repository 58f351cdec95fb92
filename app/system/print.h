// What `lamp` prints: results on stdout, everything else on stderr.
// Promise: printing never throws and never ends the program. What could not be written is remembered; `main` asks for
// it at the end, so that work whose result lies in files is finished first.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "files/printable.h"

namespace lamp::app {

/// Text of the program's own, as it is.
void write_out(std::string_view text);
void write_error(std::string_view text);

/// A text made printable, as names come from anywhere; anything else as it is.
template <class Argument>
auto printable_argument(const Argument& argument) {
  if constexpr (std::is_convertible_v<const Argument&, std::string_view>)
    return printable(argument);
  else
    return argument;
}

/// fmt::format with printable arguments.
template <class... Arguments>
std::string format_printable(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  return fmt::format(fmt::runtime(fmt::string_view(format)), printable_argument(arguments)...);
}

/// Like fmt::print, to stdout, with printable arguments.
template <class... Arguments>
void print_out(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_out(format_printable(format, std::forward<Arguments>(arguments)...));
}

/// Like fmt::print, to stderr, with printable arguments.
template <class... Arguments>
void print_error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_error(format_printable(format, std::forward<Arguments>(arguments)...));
}

/// Lines of at most `width` letters, broken at blanks where words allow it; those behind the first begin with `indent`
/// blanks. Letters are UTF-8.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width, std::size_t indent);

/// Whether progress is shown: on a terminal, unless it was hidden.
[[nodiscard]] bool shows_progress();
void hide_progress();

/// Flushes stdout. The `errno` of the first of its writes that failed, or 0.
[[nodiscard]] int output_problem();
/// The same of stderr.
[[nodiscard]] int error_output_problem();

}  // namespace lamp::app
