// lamp: renders, looks at, verifies and compares light culling. One command line, one place where errors end.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/complain.h"
#include "lamplight/version.h"
#include "system/console.h"
#include "system/print.h"
#include "system/signals.h"

namespace {

using lamp::app::Exit;
using lamp::app::help_text;
using lamp::app::Run;
using lamp::app::write_out;

constexpr const char* WELCOME =
    "Lamplight finds which of many lights reach each part of a picture. Try:\n"
    "  lamp render                            render a scene with 4096 lights to lamp.png\n"
    "  lamp render --heatmap heat.png         and show how many lights each pixel walks\n"
    "  lamp verify                            check that no method misses a light\n"
    "  lamp compare tiled clustered           compare two methods: compare.png\n"
    "  lamp bench --out out/quick             measure methods; the report is out/quick/report.html\n"
    "  lamp capture --out frame               write one frame as files, a scene for other commands\n"
    "  lamp list methods                      list the methods; also scenes, suites, devices\n"
    "  lamp info atrium                       say what a scene holds\n"
    "  lamp completion bash                   a script that completes commands; also zsh, fish\n"
    "`lamp help COMMAND` or `lamp COMMAND --help` explains a command, `lamp --version` names the release.\n";

Exit run(int argc, char** argv) {
  CLI::App app("Lamplight: light culling for scenes with very many moving lights", "lamp");
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", "lamp " + std::string(lamp::version()), "Print the version and exit");
  app.footer(
      "Examples:\n"
      "  lamp render atrium --lights 4096 --out atrium.png\n"
      "  lamp verify blocks --method tiled\n"
      "Exit codes: 0 done, 1 a check failed, 2 bad input or output that cannot be written, 3 no usable device,\n"
      "4 a check could not be made");
  const std::vector<std::pair<const char*, Run>> commands{
      {"render", lamp::app::add_render(app)},
      {"verify", lamp::app::add_verify(app)},
      {"compare", lamp::app::add_compare(app)},
      {"capture", lamp::app::add_capture(app)},
      {"probe", lamp::app::add_probe(app)},
      {"bench", lamp::app::add_bench(app, {argv, static_cast<std::size_t>(argc)})},
      {"report", lamp::app::add_report(app)},
      {"info", lamp::app::add_info(app)},
      {"list", lamp::app::add_list(app)},
      {"completion", lamp::app::add_completion(app)},
      {"help", lamp::app::add_help(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw lamp::app::parse_error(app, error);
    const std::vector<CLI::App*> asked = app.get_subcommands();
    if (error.get_name() == "CallForVersion")
      write_out(app.version() + "\n");
    else
      write_out(help_text(asked.empty() ? app : *asked.front()));
    return Exit::done;
  }
  for (const auto& [name, command] : commands) {
    if (!app.got_subcommand(name)) continue;
    lamp::app::check_repeats(*app.get_subcommand(name));
    lamp::app::check_values(*app.get_subcommand(name));
    lamp::app::check_pairs(*app.get_subcommand(name));
    return command();
  }
  write_out(WELCOME);
  return Exit::done;
}

/// The exit code, once it is known whether everything that was printed has arrived.
Exit checked(Exit exit) {
  const int problem = lamp::app::output_problem();
  if (problem == EPIPE) lamp::app::die_of_broken_pipe();
  if (problem != 0)
    exit = lamp::app::complain(
        "lamp", "standard output: cannot be written: " + std::generic_category().message(problem), Exit::bad_input);
  const bool all_was_said = lamp::app::error_output_problem() == 0;
  return exit == Exit::done && !all_was_said ? Exit::bad_input : exit;
}

}  // namespace

int main(int argc, char** argv) {
  lamp::app::open_standard_streams();
  lamp::app::watch_signals();
  try {
    return static_cast<int>(checked(lamp::app::run_or_complain("lamp", [&] { return run(argc, argv); })));
  } catch (const lamp::app::Interrupted& stopped) {
    static_cast<void>(lamp::app::output_problem());  // flushes
    lamp::app::die_of(stopped.signal);
  }
}
