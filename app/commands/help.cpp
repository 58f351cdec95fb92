// lamp help: the same as --help, for those who ask in words.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include <memory>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "system/print.h"

namespace lamp::app {
namespace {

Exit help(const CLI::App& app, const std::string& name) {
  if (name.empty()) {
    write_out(help_text(app));
    return Exit::done;
  }
  const CLI::App* command = find_command(app, name);
  if (command == nullptr) throw unknown_command(app, name);
  write_out(help_text(*command));
  return Exit::done;
}

}  // namespace

Run add_help(CLI::App& app) {
  CLI::App* command = app.add_subcommand("help", "Explain a command, as lamp COMMAND --help does");
  auto name = std::make_shared<std::string>();
  command->add_option("command", *name, "the command; without one, all are listed")->type_name("COMMAND");
  command->footer("Examples:\n  lamp help render");
  return [&app, name] { return help(app, *name); };
}

}  // namespace lamp::app
