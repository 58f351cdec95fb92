// What `lamp` prints: results on stdout, everything else on stderr.
// Promise: printing never throws and never ends the program. What could not be written is remembered; `main` asks for
// it at the end, so that work whose result lies in files is finished first. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace lamp::app {

/// Puts something in place of closed standard streams, so that no file that is opened later takes their numbers and
/// receives what is printed. Writing to them is still an error. To be called first of all.
void open_standard_streams();

void write_out(std::string_view text);
void write_error(std::string_view text);

/// Like fmt::print, to stdout.
template <class... Arguments>
void print_out(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_out(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Like fmt::print, to stderr.
template <class... Arguments>
void print_error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  write_error(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Whether progress is shown: on a terminal, unless it was hidden.
[[nodiscard]] bool shows_progress();
void hide_progress();

/// Flushes stdout. The `errno` of the first of its writes that failed, or 0.
[[nodiscard]] int output_problem();
/// The same of stderr.
[[nodiscard]] int error_output_problem();

}  // namespace lamp::app
