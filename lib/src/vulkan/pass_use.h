// How passes and look-ups use a resource, from the access that a plan declares.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/plan.h"
#include "lamplight/vulkan/recorder.h"

namespace lamp::vulkan {

[[nodiscard]] inline Use use_of(const Resource& resource, Access access, VkPipelineStageFlags2 stages) {
  VkAccessFlags2 flags = 0;
  const bool sampled = resource.image != VK_NULL_HANDLE;
  const bool uniform = resource.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  if (access != Access::write)
    flags |= sampled   ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
             : uniform ? VK_ACCESS_2_UNIFORM_READ_BIT
                       : VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  if (access != Access::read) flags |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  return {.resource = resource, .stages = stages, .access = flags};
}

/// Where a pass's shaders run; none of a host pass.
[[nodiscard]] inline VkPipelineStageFlags2 shader_stages(const Pass& pass) {
  switch (pass.kind) {
    case PassKind::compute:
      return VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    case PassKind::raster:
      return VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    case PassKind::host:
      break;
  }
  return 0;
}

}  // namespace lamp::vulkan
