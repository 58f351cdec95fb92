// lamp list: methods, look-ups, scenes, suites, devices, pipelines.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/suite.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/list_lookups.h"
#include "commands/list_pipelines.h"
#include "commands/request.h"
#include "files/read_json.h"
#include "gpu/context.h"
#include "lamplight/method.h"
#include "scene/builtin.h"
#include "system/print.h"

namespace lamp::app {
namespace {

nlohmann::json option_json(const OptionSpec& spec) {
  nlohmann::json json{{"key", spec.key}, {"help", spec.help}, {"default", spec.fallback}};
  if (!spec.choices.empty())
    json["choices"] = spec.choices;
  else
    json.update({{"min", spec.min}, {"max", spec.max}});
  return json;
}

nlohmann::json method_json(const Method& m) {
  nlohmann::json options = nlohmann::json::array();
  for (const OptionSpec& spec : m.options) options.push_back(option_json(spec));
  return {{"name", m.name},
          {"title", m.title},
          {"source", m.source},
          {"summary", m.summary},
          {"result", m.result},
          {"ordered", m.ordered},
          {"approximate", m.approximate},
          {"needs_depth", m.needs_depth},
          {"any_depth", m.any_depth},
          {"any_point", m.any_point},
          {"options", options}};
}

nlohmann::json methods_json() {
  nlohmann::json array = nlohmann::json::array();
  for (const Method& m : methods()) array.push_back(method_json(m));
  return array;
}

void print_option(const OptionSpec& spec) {
  const std::string values = spec.choices.empty() ? fmt::format("{} .. {}", spec.min, spec.max)
                                                  : fmt::format("{}", fmt::join(spec.choices, " | "));
  print_out("    {:<16} {} (default {}): {}\n", spec.key, values, spec.fallback, spec.help);
}

void print_method(const Method& m) {
  print_out("{:<20} {}{}{}\n  {}\n  {}\n", m.name, m.title, m.ordered ? "" : " [unordered]",
            m.approximate ? " [approximate]" : "", m.summary, m.source);
}

void print_methods() {
  for (const Method& m : methods()) print_method(m);
  write_out(
      "unordered: its lists need not ascend, so that a picture may differ from brute force's in the last bits of its "
      "sums. approximate: it may miss lights, as its source does.\n"
      "`lamp list methods NAME` shows a method's options. --method auto, the default, takes the method that is "
      "expected "
      "to be fastest (docs/auto.md).\n");
}

/// One method, with its options.
Exit list_method(const std::string& name, bool json) {
  const Method& method = parse_method(name);
  if (json) {
    write_out(json_text(method_json(method), 2) + "\n");
    return Exit::done;
  }
  print_method(method);
  if (!method.options.empty()) write_out("  options, for --option KEY=VALUE:\n");
  for (const OptionSpec& spec : method.options) print_option(spec);
  return Exit::done;
}

nlohmann::json scenes_json() {
  nlohmann::json array = nlohmann::json::array();
  for (const BuiltinScene& scene : builtin_scenes())
    array.push_back({{"name", scene.name}, {"summary", scene.summary}});
  return array;
}

void print_scenes() {
  for (const BuiltinScene& scene : builtin_scenes()) print_out("{:<14} {}\n", scene.name, scene.summary);
  print_out("Any .gltf or .glb file is a scene too, and any capture (docs/capture.md).\n");
}

nlohmann::json devices_json(std::span<const DeviceRow> rows) {
  nlohmann::json array = nlohmann::json::array();
  for (const DeviceRow& row : rows)
    array.push_back({{"name", row.name},
                     {"kind", row.kind},
                     {"driver", row.driver},
                     {"usable", row.problem.empty()},
                     {"problem", row.problem}});
  return array;
}

void print_devices(std::span<const DeviceRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    print_out("{} {}, {}, driver {}{}\n", i, rows[i].name, rows[i].kind, rows[i].driver,
              rows[i].problem.empty() ? "" : "; cannot be used: " + rows[i].problem);
}

nlohmann::json suites_json() {
  nlohmann::json json = nlohmann::json::array();
  for (const std::string& name : suite_names()) {
    const Suite suite = load_suite(name);
    json.push_back({{"name", name}, {"title", suite.title}, {"about", suite.about}, {"source", suite.source}});
  }
  return json;
}

void print_suites() {
  for (const std::string& name : suite_names()) {
    const Suite suite = load_suite(name);
    print_out("{:<21}{}\n", name, suite.title);
    if (!suite.source.empty()) print_out("{:<21}{}\n", "", suite.source);
  }
}

constexpr std::string_view KINDS[] = {"methods", "lookups", "scenes", "suites", "devices", "pipelines"};

struct ListOptions {
  std::string what;
  std::string name;
  std::string device;
  bool json = false;
};

Exit list(const ListOptions& o) {
  const auto& [what, name, device, json] = o;
  static_cast<void>(parse_name("list", what, KINDS));
  if (what == "pipelines") return list_pipelines_of(name, device, json);
  if (!device.empty()) throw Error("option --device: was not expected; pipelines alone are made for a device");
  if (!name.empty() && what != "methods")
    throw Error(fmt::format("argument '{}': was not expected; only a method has more to show", name));
  if (!name.empty()) return list_method(name, json);
  if (what == "lookups") return list_lookups(json);
  if (what == "devices") {
    const std::vector<DeviceRow> rows = list_devices();
    if (json)
      write_out(json_text(devices_json(rows), 2) + "\n");
    else
      print_devices(rows);
    return rows.empty() ? Exit::no_device : Exit::done;
  }
  const auto [as_json, print] = what == "methods"  ? std::pair(&methods_json, &print_methods)
                                : what == "suites" ? std::pair(&suites_json, &print_suites)
                                                   : std::pair(&scenes_json, &print_scenes);
  if (json)
    write_out(json_text(as_json(), 2) + "\n");
  else
    print();
  return Exit::done;
}

}  // namespace

Run add_list(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "List methods, look-ups, scenes, suites, devices or pipelines");
  auto o = std::make_shared<ListOptions>();
  command->add_option("what", o->what, "methods, lookups, scenes, suites, devices or pipelines")
      ->type_name("WHAT")
      ->required();
  command->add_option("name", o->name, "a method, to see its options or its pipelines alone")->type_name("NAME");
  command->add_option("--device", o->device, "what pipelines are made for: number or part of the name of a device");
  add_json_flag(*command, o->json, "print an array of objects, of one method or of pipelines an object");
  command->footer(
      "Examples:\n"
      "  lamp list methods\n"
      "  lamp list methods tiled\n"
      "  lamp list lookups                 what a shader includes to read the result of each method\n"
      "  lamp list devices --json\n"
      "  lamp list pipelines lamplight     compiles them: registers and spills, where the driver tells");
  return [o] { return list(*o); };
}

}  // namespace lamp::app
