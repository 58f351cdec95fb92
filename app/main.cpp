// lamp: renders, looks at, verifies and compares light culling. One command line, one place where errors end.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>
#include <utility>
#include <vector>

#include "commands/commands.h"

namespace {

using lamp::app::Exit;
using lamp::app::Run;

constexpr const char* WELCOME =
    "Lamplight: scenes with very many moving lights. Try:\n"
    "  lamp render                                  a picture: lamp.png\n"
    "  lamp render --heatmap heat.png               and how many lights each part of it sees\n"
    "  lamp verify                                  is any light missed? every method, against the oracle\n"
    "  lamp compare tiled clustered                 two methods side by side: compare.png\n"
    "  lamp list methods                            what there is\n"
    "`lamp COMMAND --help` explains each.\n";

int run(int argc, char** argv) {
  CLI::App app("Lamplight: light culling for scenes with very many moving lights", "lamp");
  app.require_subcommand(0, 1);
  const std::vector<std::pair<const char*, Run>> commands{{"render", lamp::app::add_render(app)},
                                                          {"verify", lamp::app::add_verify(app)},
                                                          {"compare", lamp::app::add_compare(app)},
                                                          {"list", lamp::app::add_list(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "lamp: {}\n", error.what());
    return static_cast<int>(Exit::bad_input);
  }
  for (const auto& [name, command] : commands)
    if (app.got_subcommand(name)) return static_cast<int>(command());
  fmt::print("{}", WELCOME);
  return static_cast<int>(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const lamp::app::Error& error) {
    fmt::print(stderr, "lamp: {}\n", error.what());
    return static_cast<int>(error.exit());
  } catch (const std::exception& error) {
    fmt::print(stderr, "lamp: {}\n", error.what());
    return static_cast<int>(Exit::bad_input);
  }
}
