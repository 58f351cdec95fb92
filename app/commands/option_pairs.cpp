// Options that contradict each other, or that nobody would read without another.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "commands/command_line.h"
#include "commands/request.h"

namespace lamp::app {
namespace {

bool is_given(const CLI::App& command, const char* name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option != nullptr && option->count() != 0;
}

bool is_off(const CLI::Option& option) { return option.results().size() == 1 && option.results().front() == "off"; }

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
  if (const auto cut = cut_by_shadows(command.get_option("--option")->results()))
    throw Error(fmt::format("--option {}: cuts lights by their shadow maps; expected --shadows FILTER too", *cut));
}

/// Look-ups at points that no picture has: nothing of a picture matters.
void check_point_options(const CLI::App& command) {
  constexpr std::array MATTER{"--help",   "scene",    "--scene",      "--quiet",  "--size",   "--camera",
                              "--frame",  "--lights", "--spots",      "--still",  "--range",  "--seed",
                              "--moving", "--device", "--shader-dir", "--method", "--option", "--points",
                              "--cut",    "--json",   "--calibration"};
  if (!is_given(command, "--points") || is_given(command, "--still-lists")) return;
  for (const CLI::Option* option : command.get_options())
    if (option->count() != 0 && std::ranges::find(MATTER, option->get_name()) == MATTER.end() && !is_off(*option))
      throw Error(fmt::format("{}: says nothing of look-ups at points; expected no --points, or --still-lists with it",
                              option->get_name()));
}

}  // namespace

void check_pairs(const CLI::App& command) {
  for (const char* option : {"--frame", "--frames"}) {
    if (!is_given(command, "--camera") || !is_given(command, option)) continue;
    const std::string& value = command.get_option(option)->results().front();
    // Of bench and record --frames is a number of them.
    if (std::string_view(option) == "--frame" || value.find("..") != std::string::npos)
      throw Error(fmt::format("{} {}: has the camera of the flight; expected no --camera", option, value));
  }
  check_point_options(command);
  check_shadow_options(command);
}

}  // namespace lamp::app
