// Options that contradict each other, or that nobody would read without another.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

#include "commands/command_line.h"

namespace lamp::app {
namespace {

bool is_given(const CLI::App& command, const char* name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option != nullptr && option->count() != 0;
}

/// A state that lamp-view saved may have shadows. With `--shadows off` the others may stay where they are.
bool may_have_shadows(const CLI::App& command) {
  return command.get_option_no_throw("--shadows") == nullptr || is_given(command, "--shadows") ||
         is_given(command, "--state");
}

void check_shadow_options(const CLI::App& command) {
  if (may_have_shadows(command)) return;
  for (const CLI::Option* option : command.get_options())
    if (option->count() != 0 && option->get_group() == "Shadows")
      throw Error(fmt::format("{}: no light casts a shadow; expected --shadows FILTER too", option->get_name()));
  if (!is_given(command, "--option")) return;
  for (const std::string& value : command.get_option("--option")->results())
    for (const std::string_view cut : {"occlusion=radial", "proxy=cut"})
      if (value == cut)
        throw Error(fmt::format("--option {}: cuts lights by their shadow maps; expected --shadows FILTER too", cut));
}

}  // namespace

void check_pairs(const CLI::App& command) {
  if (is_given(command, "--camera") && is_given(command, "--frame"))
    throw Error(fmt::format("--frame {}: has the camera of the flight; expected no --camera",
                            command.get_option("--frame")->results().front()));
  check_shadow_options(command);
}

}  // namespace lamp::app
