// How the renderer's passes use resources, as the recorder wants to be told.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/image.h"

namespace lamp::app {

inline constexpr VkPipelineStageFlags2 DEPTH_STAGES =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
inline constexpr VkPipelineStageFlags2 GRAPHICS_SHADERS =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

enum class Load : std::uint8_t { keep, clear };

/// Read and written in compute shaders.
[[nodiscard]] inline vulkan::Use changes(const vulkan::Resource& resource) {
  return {.resource = resource,
          .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
          .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}

/// Read in shaders.
[[nodiscard]] inline vulkan::Use reads(const vulkan::Resource& resource, VkPipelineStageFlags2 stages) {
  const bool image = resource.image != VK_NULL_HANDLE;
  const bool uniform = resource.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  return {.resource = resource,
          .stages = stages,
          .access = image     ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
                    : uniform ? VK_ACCESS_2_UNIFORM_READ_BIT
                              : VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
}

[[nodiscard]] inline vulkan::Use draws_color(const GpuImage& image, Load load) {
  return {.resource = image.attachment(),
          .stages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
          .access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
          .discard = load == Load::clear};
}

[[nodiscard]] inline vulkan::Use draws_depth(const GpuImage& image, Load load) {
  return {.resource = image.attachment(),
          .stages = DEPTH_STAGES,
          .access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
          .discard = load == Load::clear};
}

/// Tested against, and read in fragment shaders at the same time.
[[nodiscard]] inline vulkan::Use tests_depth(const GpuImage& image) {
  return {.resource = image.sampled(),
          .stages = DEPTH_STAGES | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
          .access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
}

[[nodiscard]] inline vulkan::Use copies_from(const vulkan::Resource& resource) {
  return {.resource = resource, .stages = VK_PIPELINE_STAGE_2_COPY_BIT, .access = VK_ACCESS_2_TRANSFER_READ_BIT};
}

[[nodiscard]] inline vulkan::Use copies_to(const vulkan::Resource& resource) {
  return {.resource = resource,
          .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
          .access = VK_ACCESS_2_TRANSFER_WRITE_BIT,
          .discard = resource.image != VK_NULL_HANDLE};
}

/// All of the image's first level.
inline void record_copy(vulkan::Recorder& recorder, const GpuImage& from, const vulkan::Buffer& to) {
  recorder.barrier({copies_from(from.transfer_source()), copies_to(vulkan::Resource::storage(to.handle()))});
  const VkBufferImageCopy whole = from.whole();
  vkCmdCopyImageToBuffer(recorder.commands(), from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1,
                         &whole);
}

[[nodiscard]] inline vulkan::Use host_reads(const vulkan::Resource& resource) {
  return {.resource = resource, .stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT};
}

/// The same, for the host to read.
inline void record_readback(vulkan::Recorder& recorder, const GpuImage& from, const vulkan::Buffer& to) {
  record_copy(recorder, from, to);
  recorder.barrier({host_reads(vulkan::Resource::storage(to.handle()))});
}

}  // namespace lamp::app
