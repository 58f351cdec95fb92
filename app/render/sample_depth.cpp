// Draws depth into one sample after the other.
// SPDX-License-Identifier: Apache-2.0
#include "render/sample_depth.h"

#include <fmt/format.h>

#include <array>
#include <cassert>

#include "error.h"
#include "gpu/check.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

struct Push {
  glm::ivec2 offset_px;
  float beyond;
};

vulkan::Pipeline sample_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const GpuImageInfo& image,
                                 std::uint32_t sample) {
  return take(vulkan::Pipeline::graphics(device,
                                         {.name = "sample depth",
                                          .bindings = {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}},
                                          .push_constant_bytes = sizeof(Push)},
                                         shaders.spirv("full_screen"), shaders.spirv("sample_depth"),
                                         {.samples = image.samples,
                                          .sample_mask = 1U << sample,
                                          .depth = image.format,
                                          .depth_write = true,
                                          .depth_compare = VK_COMPARE_OP_ALWAYS}));
}

}  // namespace

std::span<const glm::dvec2> sample_places(std::uint32_t samples) {
  static constexpr std::array<glm::dvec2, 1> ONE{{{0.5, 0.5}}};
  static constexpr std::array<glm::dvec2, 2> TWO{{{0.75, 0.75}, {0.25, 0.25}}};
  static constexpr std::array<glm::dvec2, 4> FOUR{{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
  static constexpr std::array<glm::dvec2, 8> EIGHT{{{0.5625, 0.3125},
                                                    {0.4375, 0.6875},
                                                    {0.8125, 0.5625},
                                                    {0.3125, 0.1875},
                                                    {0.1875, 0.8125},
                                                    {0.0625, 0.4375},
                                                    {0.6875, 0.9375},
                                                    {0.9375, 0.0625}}};
  switch (samples) {
    case 1:
      return ONE;
    case 2:
      return TWO;
    case 4:
      return FOUR;
    default:
      assert(samples == 8 && "1, 2, 4 or 8");
      return EIGHT;
  }
}

SampledDepth::SampledDepth(const vulkan::Device& device, const ShaderLibrary& shaders, const SampledDepthInfo& info)
    : info_(info),
      image_(device, {.name = "sampled depth",
                      .width = info.width,
                      .height = info.height,
                      .samples = static_cast<VkSampleCountFlagBits>(info.samples),
                      .format = info.format,
                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}) {
  for (std::uint32_t i = 0; i < info.samples; ++i)
    pipelines_.push_back(sample_pipeline(device, shaders, image_.info(), i));
}

void SampledDepth::record(vulkan::Recorder& recorder, const GpuImage& picture, std::uint32_t sample) const {
  const VkCommandBuffer commands = recorder.commands();
  const Load load = sample == 0 ? Load::clear : Load::keep;
  recorder.barrier({draws_depth(image_, load), reads(picture.sampled(), VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT)});
  const VkRenderingAttachmentInfo depth{
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
      .imageView = image_.view(),
      .imageLayout = image_.attachment().layout,
      .loadOp = load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
      .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRect2D area{.extent = {info_.width, info_.height}};
  const VkRenderingInfo rendering{
      .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1, .pDepthAttachment = &depth};
  const VkViewport viewport{
      .width = static_cast<float>(info_.width), .height = static_cast<float>(info_.height), .maxDepth = 1.0F};
  vkCmdBeginRendering(commands, &rendering);
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
  const Push push{.offset_px = {info_.offset.x, info_.offset.y}, .beyond = info_.beyond};
  const vulkan::Pipeline& pipeline = pipelines_[sample];
  recorder.bind(pipeline, std::array{vulkan::Bound{0, picture.sampled()}});
  vkCmdPushConstants(commands, pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), &push);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
}

void check_depth_samples(const vulkan::Device& device, std::uint32_t samples) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device.physical, &properties);
  const VkSampleCountFlags has =
      properties.limits.framebufferDepthSampleCounts & properties.limits.sampledImageDepthSampleCounts;
  if ((has & samples) != 0) return;
  std::vector<std::uint32_t> counts;
  for (const std::uint32_t count : {1U, 2U, 4U, 8U})
    if ((has & count) != 0) counts.push_back(count);
  throw Error(fmt::format("depth of {} samples a pixel: device {} has depth images of {}", samples,
                          properties.deviceName, fmt::join(counts, ", ")),
              Exit::no_device);
}

}  // namespace lamp::app
