// Turns the parser's complaints into the tool's: what, where, what was expected, and the nearest names.
// SPDX-License-Identifier: Apache-2.0
#include "commands/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "lamplight/method.h"

namespace lamp::app {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool repeats(const CLI::Option& option) { return option.get_expected_max() > 1; }

Error unknown_with_help(std::string_view what, const std::string& given, const std::vector<std::string>& names,
                        const std::string& help) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return Error(fmt::format("{}; {}", unknown_name(what, given, views).what(), help));
}

Error given_twice(const CLI::Option& option) {
  return Error(fmt::format("option '{}': is given {} times, expected once", option.get_name(), option.count()));
}

/// Those of the parser's own sentences that say too little.
std::string words_of(const CLI::App& command, const CLI::ParseError& error) {
  if (error.get_name() != "ArgumentMismatch") return error.what();
  for (const CLI::Option* option : command.get_options()) {
    const auto most = static_cast<std::size_t>(std::max(1, option->get_expected_max()));
    if (option->count() > most && most > 1)
      return fmt::format("{}: expected at most {}, got {}", option->get_name(), most, option->count());
    if (option->count() > most) return given_twice(*option).what();
    if (option->count() == 0 || most == 1) continue;
    if (const auto least = static_cast<std::size_t>(option->get_expected_min()); option->count() < least)
      return fmt::format("{}: expected {} values, got {}", option->get_name(), least, option->count());
  }
  const std::string text = error.what();
  return fmt::format("option '{}': expected a value behind it", text.substr(0, text.find(':')));
}

/// The first argument that nobody took, or nothing.
std::string first_extra(const CLI::App& command) {
  const std::vector<std::string> extras = command.remaining();
  return extras.empty() ? std::string() : extras.front();
}

}  // namespace

CLI::Validator whole_number(std::uint64_t min, std::uint64_t max) {
  const auto check = [min, max](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool octal = text.size() > 1 && text.front() == '0';  // the parser would read 010 as 8
    if (error == std::errc{} && end == text.data() + text.size() && !octal && number >= min && number <= max) return {};
    return fmt::format("expected a whole number from {} to {}, got '{}'", min, max, text);
  };
  return CLI::Validator(check, "");
}

CLI::Validator number_between(double min, double max) {
  const auto check = [min, max](const std::string& text) -> std::string {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (whole && number >= min && number <= max) return {};
    return fmt::format("expected a number from {} to {}, got '{}'", min, max, text);
  };
  return CLI::Validator(check, "");
}

std::string one_of(const std::string& text, std::span<const std::string_view> names) {
  if (std::ranges::find(names, text) != names.end()) return {};
  return fmt::format("there is no '{}'; the nearest are {}", text, fmt::join(nearest_names(text, names), ", "));
}

Error unknown_name(std::string_view what, std::string_view given, std::span<const std::string_view> names) {
  return Error(fmt::format("{} '{}': there is none of that name; the nearest are {}", what, given,
                           fmt::join(nearest_names(given, names), ", ")));
}

std::size_t parse_name(std::string_view option, std::string_view text, std::span<const std::string_view> names) {
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) throw unknown_name(option, text, names);
  return static_cast<std::size_t>(found - names.begin());
}

bool is_given(const CLI::App& command, const char* name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option != nullptr && option->count() != 0;
}

std::string value_of(const CLI::App& command, const char* name) {
  return is_given(command, name) ? command.get_option(name)->results().front() : std::string();
}

const CLI::App* find_command(const CLI::App& app, std::string_view name) {
  const std::vector<const CLI::App*> commands = app.get_subcommands({});
  const auto found = std::ranges::find(commands, name, [](const CLI::App* command) { return command->get_name(); });
  return found == commands.end() ? nullptr : *found;
}

Error unknown_command(const CLI::App& app, const std::string& given) {
  return unknown_with_help("command", given, command_names(app), "see lamp --help");
}

void check_repeats(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (!repeats(*option) && option->count() > 1) throw given_twice(*option);
}

void check_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty() && std::ranges::find(option->results(), "") != option->results().end())
      throw Error(fmt::format("{} '': expected a value", option->get_name()));
}

Error parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::string help = "see " + (parsed.empty() ? app.get_name() : "lamp " + command.get_name()) + " --help";
  const std::string extra = first_extra(command);
  if (const std::string before = first_extra(app); extra.empty() && !parsed.empty() && before.starts_with("-"))
    return Error(fmt::format("option '{}': stands before the command, expected: lamp {} {} ...", before,
                             command.get_name(), before));
  if (extra.empty()) return Error(fmt::format("{}; {}", words_of(command, error), help));
  if (extra.starts_with("-")) return unknown_with_help("option", extra, option_names(command), help);
  if (parsed.empty() && !app.get_subcommands({}).empty()) return unknown_command(app, extra);
  return Error(fmt::format("argument '{}': was not expected; {}", extra, help));
}

std::string help_text(const CLI::App& command) {
  const std::string name = command.get_parent() == nullptr ? command.get_name() : "lamp " + command.get_name();
  std::string text = command.get_formatter()->make_help(&command, name, CLI::AppFormatMode::Normal);
  for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

}  // namespace lamp::app
