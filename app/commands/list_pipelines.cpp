// Prints pipelines with the statistics of their executables.
// SPDX-License-Identifier: Apache-2.0
#include "commands/list_pipelines.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/request.h"
#include "files/read_json.h"
#include "gpu/context.h"
#include "render/pipeline_list.h"
#include "system/print.h"

namespace lamp::app {
namespace {

nlohmann::json executables_json(const vulkan::Pipeline& pipeline) {
  nlohmann::json array = nlohmann::json::array();
  for (const vulkan::PipelineStatistic& statistic : pipeline.statistics()) {
    if (array.empty() || array.back().at("name") != statistic.executable)
      array.push_back({{"name", statistic.executable}, {"statistics", nlohmann::json::object()}});
    array.back()["statistics"][statistic.name] = statistic.value;
  }
  return array;
}

nlohmann::json as_json(const DeviceRow& device, std::span<const ListedPipeline> pipelines) {
  nlohmann::json array = nlohmann::json::array();
  for (const ListedPipeline& listed : pipelines)
    array.push_back({{"method", listed.method},
                     {"option", listed.option},
                     {"use", listed.use},
                     {"name", listed.pipeline.name()},
                     {"executables", executables_json(listed.pipeline)}});
  return {{"device", device.name}, {"driver", device.driver}, {"pipelines", array}};
}

std::string described(const ListedPipeline& listed) {
  std::string text = listed.method.empty() ? "geometry" : listed.method;
  if (!listed.option.empty()) text += " " + listed.option;
  text += ": " + listed.pipeline.name();
  return listed.use.empty() ? text : text + " (" + listed.use + ")";
}

void print(const DeviceRow& device, std::span<const ListedPipeline> pipelines) {
  print_out("{} ({}): {} pipelines\n", device.name, device.driver, pipelines.size());
  for (const ListedPipeline& listed : pipelines) {
    print_out("{}\n", described(listed));
    std::string executable;
    for (const vulkan::PipelineStatistic& statistic : listed.pipeline.statistics()) {
      if (statistic.executable != executable) print_out("  {}\n", statistic.executable);
      executable = statistic.executable;
      print_out("    {:<28} {}\n", statistic.name, statistic.value);
    }
  }
}

}  // namespace

Exit list_pipelines_of(const std::string& method, const std::string& device, bool json) {
  const std::span<const Method> of = method.empty() ? methods() : std::span(&parse_method(method), 1);
  const Context context({.device = device, .pipeline_statistics = true});
  const std::vector<ListedPipeline> pipelines = list_pipelines(context.device(), ShaderLibrary(), of);
  if (json)
    write_out(json_text(as_json(context.row(), pipelines), 2) + "\n");
  else
    print(context.row(), pipelines);
  return Exit::done;
}

}  // namespace lamp::app
