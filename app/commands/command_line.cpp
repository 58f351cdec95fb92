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

std::string nearest(const std::string& wanted, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return fmt::format("{}", fmt::join(nearest_names(wanted, views), ", "));
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

Error parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::string help = "see " + (parsed.empty() ? "lamp" : "lamp " + command.get_name()) + " --help";
  const std::string extra = first_extra(command);
  if (extra.empty()) return Error(fmt::format("{}; {}", error.what(), help));
  if (extra.starts_with("-"))
    return Error(fmt::format("option '{}': there is none of that name; the nearest are {}; {}", extra,
                             nearest(extra, option_names(command)), help));
  if (parsed.empty())
    return Error(fmt::format("command '{}': there is none of that name; the nearest are {}; {}", extra,
                             nearest(extra, command_names(app)), help));
  return Error(fmt::format("argument '{}': was not expected; {}", extra, help));
}

std::string escaped_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      line += c;
  }
  return line;
}

}  // namespace lamp::app
