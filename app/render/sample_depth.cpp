// Draws depth into one sample after the other.
// SPDX-License-Identifier: Apache-2.0
#include "render/sample_depth.h"

#include <array>
#include <cassert>
#include <glm/gtc/matrix_access.hpp>

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

View view_through(const View& view, glm::dvec2 at) {
  const glm::dvec2 shift = 2.0 * (0.5 - at) / glm::dvec2(view.width(), view.height());
  glm::dmat4 projection = view.clip_from_view();
  const glm::dvec4 w = glm::row(projection, 3);
  projection = glm::row(projection, 0, glm::row(projection, 0) + shift.x * w);
  projection = glm::row(projection, 1, glm::row(projection, 1) + shift.y * w);
  return take(View::create(view.width(), view.height(), projection, view.view_from_world()));
}

GpuImage sampled_depth(Context& context, const ShaderLibrary& shaders, std::span<const GpuImage* const> of_samples,
                       const SampledDepthInfo& info) {
  const vulkan::Device& device = context.device();
  GpuImage image(device, {.name = "sampled depth",
                          .width = info.width,
                          .height = info.height,
                          .samples = static_cast<VkSampleCountFlagBits>(of_samples.size()),
                          .format = info.format,
                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT});
  std::vector<vulkan::Pipeline> pipelines;
  for (std::uint32_t i = 0; i < of_samples.size(); ++i)
    pipelines.push_back(sample_pipeline(device, shaders, image.info(), i));
  context.submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(device, commands, tracker);
    for (const GpuImage* one : of_samples) tracker.assume(one->sampled());
    recorder.barrier({draws_depth(image, Load::clear)});
    const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = image.view(),
                                          .imageLayout = image.attachment().layout,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRect2D area{.extent = {info.width, info.height}};
    const VkRenderingInfo rendering{
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1, .pDepthAttachment = &depth};
    const VkViewport viewport{
        .width = static_cast<float>(info.width), .height = static_cast<float>(info.height), .maxDepth = 1.0F};
    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
    for (std::size_t i = 0; i < of_samples.size(); ++i) {
      const Push push{.offset_px = {info.offset.x, info.offset.y}, .beyond = info.beyond};
      recorder.bind(pipelines[i], std::array{vulkan::Bound{0, of_samples[i]->sampled()}});
      vkCmdPushConstants(commands, pipelines[i].layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), &push);
      vkCmdDraw(commands, 3, 1, 0, 0);
    }
    vkCmdEndRendering(commands);
    recorder.barrier({reads(image.sampled(), VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)});
  });
  return image;
}

}  // namespace lamp::app
