// Names, series, groups.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "commands/bench_device.h"
#include "commands/command_line.h"
#include "files/utf8_path.h"
#include "scene/builtin.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

/// An option as suites call it: "shadow-blur" is shadow_blur, and what they have a list of is named so, "size" sizes.
std::string suite_key(std::string_view option) {
  constexpr std::array<std::string_view, 7> LISTS{"size", "range", "path", "projection", "camera", "option", "method"};
  std::string key(option);
  std::ranges::replace(key, '-', '_');
  return std::ranges::find(LISTS, option) == LISTS.end() ? key : key + "s";
}

/// Runs a check of a group. Errors begin with the suite and the series, and name its keys; where a scene was named
/// (empty), they name options.
template <class Check>
void check_in(const std::string& suite, const Group& group, const Check& check) {
  try {
    check();
  } catch (const Error& error) {
    if (suite.empty()) throw;
    throw Error(fmt::format("{}: series '{}': {}", suite, group.series, with_options_named(error.what(), suite_key)),
                error.exit());
  }
}

}  // namespace

void check_bench_name(const std::string& name) {
  const bool is_builtin = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name) != builtin_scenes().end();
  if (is_suite(name) || is_builtin || utf8_path(name).has_extension() || fs::exists(utf8_path(name))) return;
  const std::vector<std::string> suites = suite_names();
  std::vector<std::string_view> names(suites.begin(), suites.end());
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  throw Error(fmt::format("'{}': is neither a suite, a suite's .json file, nor a scene; the nearest are {}", name,
                          fmt::join(nearest_names(name, names), ", ")));
}

void check_series(std::span<const std::string> asked, const std::string& scene, const Suite& suite) {
  if (!asked.empty() && !is_suite(scene))
    throw Error(fmt::format("--series: belongs to a suite, and {} is a scene", scene));
  check_once("--series", {asked.begin(), asked.end()});
  std::vector<std::string_view> names;
  for (const Series& series : suite.series) names.push_back(series.name);
  for (const std::string& name : asked)
    if (std::ranges::find(names, name) == names.end())
      throw Error(fmt::format("--series '{}': the suite {} has none of this name; expected one of {}", name, suite.name,
                              fmt::join(names, ", ")));
}

void check_groups(const std::string& suite, std::span<Group> groups) {
  for (const Group& group : groups)
    for (const GroupEntry& entry : group.entries)
      check_in(suite, group, [&] {
        check_request(request_of(group, entry), entry.name);
        const auto cut = cut_by_shadows(entry.options);
        if (cut && has_culler(entry.host))
          throw Error(
              fmt::format("method {}: {}: a host with a Culler gives it no bounds of shadows here, expected "
                          "another host",
                          entry.name, *cut));
      });
  SceneCheck scenes;
  for (Group& group : groups) check_in(suite, group, [&] { scenes.check(group); });
}

}  // namespace lamp::app
