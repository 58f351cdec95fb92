// Asks VK_KHR_pipeline_executable_properties.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/pipeline_statistics.h"

namespace lamp::vulkan {
namespace {

double value_of(const VkPipelineExecutableStatisticKHR& statistic) {
  switch (statistic.format) {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
      return statistic.value.b32 == VK_FALSE ? 0.0 : 1.0;
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
      return static_cast<double>(statistic.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
      return static_cast<double>(statistic.value.u64);
    default:
      return statistic.value.f64;
  }
}

}  // namespace

std::vector<PipelineStatistic> read_statistics(const Device& device, VkPipeline pipeline) {
  const auto executables_of = device.vk.vkGetPipelineExecutablePropertiesKHR;
  const auto statistics_of = device.vk.vkGetPipelineExecutableStatisticsKHR;
  if (!device.pipeline_statistics || executables_of == nullptr || statistics_of == nullptr) return {};
  const VkPipelineInfoKHR info{.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pipeline = pipeline};
  std::uint32_t count = 0;
  executables_of(device.handle, &info, &count, nullptr);
  std::vector<VkPipelineExecutablePropertiesKHR> executables(
      count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
  executables_of(device.handle, &info, &count, executables.data());
  std::vector<PipelineStatistic> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const VkPipelineExecutableInfoKHR executable{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, .pipeline = pipeline, .executableIndex = i};
    std::uint32_t values = 0;
    statistics_of(device.handle, &executable, &values, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> statistics(
        values, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    statistics_of(device.handle, &executable, &values, statistics.data());
    for (const VkPipelineExecutableStatisticKHR& statistic : statistics)
      all.push_back({executables[i].name, statistic.name, value_of(statistic)});
  }
  return all;
}

}  // namespace lamp::vulkan
