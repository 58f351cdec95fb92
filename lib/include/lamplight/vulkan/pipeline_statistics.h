// What a driver says of a compiled pipeline: registers, spills, occupancy, as far as it does.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/vulkan/device.h"

namespace lamp::vulkan {

/// A number of one of a pipeline's executables (a shader stage, mostly), under the driver's own name.
struct PipelineStatistic {
  std::string executable;
  std::string name;
  double value = 0.0;
};

/// Of a pipeline that was made with VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR, on a device with
/// `pipeline_statistics`; empty where the driver has none.
[[nodiscard]] LAMPLIGHT_API std::vector<PipelineStatistic> read_statistics(const Device& device, VkPipeline pipeline);

}  // namespace lamp::vulkan
