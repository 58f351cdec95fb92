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

bool is_off(const CLI::Option& option) { return option.results().size() == 1 && option.results().front() == "off"; }

/// Four methods and a table of tests, which are always the same.
void check_panel_options(const CLI::App& command) {
  constexpr std::array DO_NOTHING{"--grow",         "--explain", "--path",         "--probes-show",
                                  "--probe-budget", "--mirror",  "--mirror-lists", "--pipeline-statistics"};
  if (!is_given(command, "--panels")) return;
  for (const char* name : DO_NOTHING)
    if (is_given(command, name))
      throw Error(fmt::format("{}: the panels have methods of their own, drawn deferred; expected no --panels", name));
  if (is_given(command, "a") && is_given(command, "--scene"))
    throw Error(fmt::format("--scene {}: beside the scene {}, expected one of them", value_of(command, "--scene"),
                            value_of(command, "a")));
}

/// A state may say both.
void check_samples(const CLI::App& command) {
  const std::string of_depth = value_of(command, "--depth-samples");
  const std::string samples = value_of(command, "--samples");
  if (!samples.empty() && !of_depth.empty() && of_depth != "1" && samples != of_depth)
    throw Error(fmt::format("--samples: got {}, but with --depth-samples {} the picture has those", samples, of_depth));
}

/// What has no picture of its own to show it in.
void check_numbers_and_places(const CLI::App& command) {
  const bool numbers = is_given(command, "--json") || is_given(command, "--stats") || is_given(command, "--panels");
  if (is_given(command, "--pipeline-statistics") && command.get_option_no_throw("--json") != nullptr && !numbers)
    throw Error("--pipeline-statistics: stands in the numbers; expected --json too");
  if (is_given(command, "--at") && is_given(command, "--camera"))
    throw Error(
        fmt::format("--camera {}: the probe is where --at says; expected one of them", value_of(command, "--camera")));
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

void check_shadow_options(const CLI::App& command, std::string_view filter) {
  const bool off = filter == "off";
  if (off && !is_given(command, "--shadows"))
    for (const CLI::Option* option : command.get_options())
      if (option->count() != 0 && option->get_group() == "Shadows")
        throw Error(fmt::format("{}: no light casts a shadow; expected --shadows FILTER too", option->get_name()));
  if (is_given(command, "--shadow-blur") && (filter == "hard" || filter == "pcf"))
    throw Error(
        fmt::format("--shadow-blur: blurs vsm and evsm, and --shadows {} is filtered where it is looked up", filter));
}

void check_pairs(const CLI::App& command) {
  for (const char* option : {"--frame", "--frames"}) {
    if (!is_given(command, "--camera") || !is_given(command, option)) continue;
    const std::string& value = command.get_option(option)->results().front();
    // Of bench and record --frames is a number of them.
    if (std::string_view(option) == "--frame" || value.find("..") != std::string::npos)
      throw Error(fmt::format("{} {}: has the camera of the flight; expected no --camera", option, value));
  }
  check_point_options(command);
  const bool casts = command.get_option_no_throw("--shadows") != nullptr;
  if (casts && !is_given(command, "--state")) {  // which the command looks into
    check_shadow_options(command, is_given(command, "--shadows") ? value_of(command, "--shadows") : "off");
  }
  check_panel_options(command);
  check_numbers_and_places(command);
  check_samples(command);
}

}  // namespace lamp::app
