// What all commands share of the command line: checks of numbers, and one line for what cannot be parsed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "error.h"

namespace lamp::app {

/// Accepts the decimal digits of a whole number from `min` to `max`; no sign, no other base.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t min, std::uint64_t max);

/// Accepts a number from `min` to `max`.
[[nodiscard]] CLI::Validator number_between(double min, double max);

/// Empty if the text is one of the names; else what was expected, with the nearest names.
[[nodiscard]] std::string one_of(const std::string& text, std::span<const std::string_view> names);

/// "--path 'defered': there is none of that name; the nearest are deferred, ...".
[[nodiscard]] Error unknown_name(std::string_view what, std::string_view given,
                                 std::span<const std::string_view> names);

/// Which of the names it is. Throws what unknown_name says.
[[nodiscard]] std::size_t parse_name(std::string_view option, std::string_view text,
                                     std::span<const std::string_view> names);

/// Whether the command has the option, and the line gives it.
[[nodiscard]] bool is_given(const CLI::App& command, const char* name);
/// Its first value; empty where it is not given.
[[nodiscard]] std::string value_of(const CLI::App& command, const char* name);

/// The command of that name, or null.
[[nodiscard]] const CLI::App* find_command(const CLI::App& app, std::string_view name);

/// The error for a command that there is not.
[[nodiscard]] Error unknown_command(const CLI::App& app, const std::string& given);

/// Throws Error for an option or flag of the command that is given twice and does not repeat by design.
void check_repeats(const CLI::App& command);
/// Throws Error for options that contradict each other, or that nobody would read without another.
void check_pairs(const CLI::App& command);
/// The same of shadows, whose filter a state may say. With `--shadows off` others may stay where they are.
void check_shadow_options(const CLI::App& command, std::string_view filter);
/// Throws Error for an option that is given an empty value.
void check_values(const CLI::App& command);

/// One line that names the command, option or argument that was not understood and, for a name, the nearest there are.
[[nodiscard]] Error parse_error(const CLI::App& app, const CLI::ParseError& error);

/// The help of the program or of one of its commands.
[[nodiscard]] std::string help_text(const CLI::App& command);

}  // namespace lamp::app
