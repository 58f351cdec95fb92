// Builds, records and submits a dispatch.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/dispatch.h"

#include "render/pass_uses.h"

namespace lamp::app {

vulkan::Buffer host_buffer(const std::string& name, std::uint64_t bytes) {
  vulkan::Buffer buffer = take(vulkan::Buffer::create(
      test_context().device(), {.name = name,
                                .bytes = bytes,
                                .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                .memory = vulkan::MemoryUse::readback}));
  std::memset(buffer.mapped().data(), 0, bytes);
  return buffer;
}

namespace {

GpuImage sampled_image(const GpuImageInfo& info, const vulkan::Buffer& staging) {
  GpuImage image(test_context().device(), info);
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    recorder.barrier({copies_to(image.transfer_target())});
    const VkBufferImageCopy whole = image.whole();
    vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
    recorder.barrier({reads(image.sampled(), VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)});
  });
  return image;
}

}  // namespace

GpuImage depth_image(std::uint32_t width, std::uint32_t height, const std::vector<float>& depth,
                     const DepthImageKind& kind) {
  return sampled_image({.name = "test depth",
                        .width = width,
                        .height = height,
                        .layers = kind.layers,
                        .format = kind.format,
                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                       host_buffer_of("depth staging", depth));
}

GpuImage float_image(std::uint32_t width, std::uint32_t height, const std::vector<glm::vec4>& texels) {
  return sampled_image({.name = "test image",
                        .width = width,
                        .height = height,
                        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                       host_buffer_of("texel staging", texels));
}

void dispatch(const Dispatch& what) {
  const vulkan::Device& device = test_context().device();
  vulkan::PipelineInfo info{.name = std::string(what.shader)};
  std::vector<vulkan::Bound> bound;
  std::vector<vulkan::Use> to_host;
  for (std::uint32_t i = 0; i < what.constants.size(); ++i) info.constants.push_back({i, what.constants[i]});
  for (std::uint32_t i = 0; i < what.resources.size(); ++i) {
    const vulkan::Resource& resource = what.resources[i];
    info.bindings.push_back({i, resource.type});
    bound.push_back({i, resource});
    if (resource.buffer != VK_NULL_HANDLE) to_host.push_back(host_reads(resource));
  }
  const vulkan::Pipeline pipeline = take(vulkan::Pipeline::compute(device, info, test_shader(what.shader)));
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(device, commands, tracker);
    std::vector<vulkan::Use> uses;
    for (const vulkan::Resource& resource : what.resources) {
      if (resource.image != VK_NULL_HANDLE) tracker.assume(resource);
      const bool image = resource.image != VK_NULL_HANDLE;
      uses.push_back({.resource = resource,
                      .access = image ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT
                                      : VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
    }
    recorder.begin_pass(what.shader, uses);
    recorder.bind(pipeline, bound);
    vkCmdDispatch(commands, what.groups.x, what.groups.y, what.groups.z);
    recorder.end_pass();
    recorder.barrier(to_host);
  });
}

}  // namespace lamp::app
