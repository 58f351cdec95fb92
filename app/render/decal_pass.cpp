// Copies what the pass reads, because it draws over the same images.
// SPDX-License-Identifier: Apache-2.0
#include "render/decal_pass.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "gpu/check.h"
#include "render/lighting_pipelines.h"
#include "render/mesh_pass.h"

namespace lamp::app {
namespace {

static_assert(static_cast<std::uint32_t>(DecalPattern::mosaic) == gpu::DECAL_MOSAIC &&
              static_cast<std::uint32_t>(DecalPattern::painting) == gpu::DECAL_PAINTING &&
              static_cast<std::uint32_t>(DecalPattern::crack) == gpu::DECAL_CRACK &&
              static_cast<std::uint32_t>(DecalPattern::moss) == gpu::DECAL_MOSS &&
              static_cast<std::uint32_t>(DecalPattern::sign) == gpu::DECAL_SIGN &&
              static_cast<std::uint32_t>(DecalPattern::plain) == gpu::DECAL_PLAIN);

GpuImage copy_target(const vulkan::Device& device, const char* name, VkFormat format, glm::uvec2 size_px) {
  return {device,
          {.name = name,
           .width = size_px.x,
           .height = size_px.y,
           .format = format,
           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}};
}

}  // namespace

vulkan::Pipeline decal_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const Plan& plan) {
  vulkan::PipelineInfo info{.name = "decals",
                            .constants = vulkan::lookup_constants(plan.lookup),
                            .bindings = {{0},
                                         {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                                         {5, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                                         {6, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
                                         {BINDING_DECALS}}};
  info.constants.push_back({CONSTANT_BOXES, 1});
  info.constants.push_back(shown_view_constant(plan));
  info.constants.push_back({CONSTANT_BOXES_ASCEND, plan.ordered ? 1U : 0U});
  for (const vulkan::DescriptorBinding& binding : vulkan::lookup_bindings(plan.lookup))
    info.bindings.push_back(binding);
  return take(vulkan::Pipeline::graphics(device, info, shaders.spirv("full_screen"),
                                         shaders.spirv("decals@" + plan.lookup.name),
                                         {.colors = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R32G32_UINT}}));
}

DecalPass::DecalPass(const vulkan::Device& device, const ShaderLibrary& shaders, const Plan& plan, glm::uvec2 size_px)
    : base_color_(copy_target(device, "base colour without decals", VK_FORMAT_R8G8B8A8_SRGB, size_px)),
      surface_(copy_target(device, "surface without decals", VK_FORMAT_R32G32_UINT, size_px)),
      pipeline_(decal_pipeline(device, shaders, plan)) {}

void DecalPass::record(vulkan::Recorder& recorder, const FrameData& data, const Targets& targets,
                       const vulkan::BoundLookUp& lookup) const {
  const std::pair<const GpuImage*, const GpuImage*> copies[] = {{&targets.base_color, &base_color_},
                                                                {&targets.surface, &surface_}};
  std::vector<vulkan::Use> copied;
  for (const auto& [from, to] : copies) {
    copied.push_back(copies_from(from->transfer_source()));
    copied.push_back(copies_to(to->transfer_target()));
  }
  recorder.begin_pass("decal copies", copied);
  for (const auto& [from, to] : copies) {
    const VkImageCopy whole{.srcSubresource = {from->aspect(), 0, 0, 1},
                            .dstSubresource = {to->aspect(), 0, 0, 1},
                            .extent = {targets.width, targets.height, 1}};
    vkCmdCopyImage(recorder.commands(), from->handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to->handle(),
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
  }
  recorder.end_pass();

  const Attachments attachments{.colors = {{&targets.base_color}, {&targets.surface}}};
  std::vector<vulkan::Bound> bound{{0, data.frame()},
                                   {1, targets.depth.sampled()},
                                   {5, base_color_.sampled()},
                                   {6, surface_.sampled()},
                                   {BINDING_DECALS, data.decals()}};
  bound.insert(bound.end(), lookup.resources.begin(), lookup.resources.end());
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, GRAPHICS_SHADERS));
  recorder.begin_pass("decals", uses);
  begin_rendering(recorder.commands(), attachments, targets);
  recorder.bind(pipeline_, bound);
  vkCmdDraw(recorder.commands(), 3, 1, 0, 0);
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

std::vector<gpu::DecalData> pack(std::span<const Decal> decals) {
  std::vector<gpu::DecalData> packed;
  for (const Decal& decal : decals) {
    const glm::mat3 axes = glm::mat3_cast(glm::normalize(decal.orientation));
    const float cos_none = std::cos(decal.none_angle);
    packed.push_back({.box = {.center = decal.center,
                              .axis_x = axes[0],
                              .axis_y = axes[1],
                              .axis_z = axes[2],
                              .half_extents = decal.half_extents},
                      .color_a = decal.color_a,
                      .color_b = decal.color_b,
                      .pattern = static_cast<std::uint32_t>(decal.pattern),
                      .seed = decal.seed,
                      .opacity = decal.opacity,
                      .relief = decal.relief,
                      .cos_none = cos_none,
                      .fade_scale = 1.0F / std::max(std::cos(decal.full_angle) - cos_none, 1e-4F)});
  }
  return packed;
}

std::vector<shared::OrientedBox> boxes_of(std::span<const gpu::DecalData> decals) {
  std::vector<shared::OrientedBox> boxes;
  boxes.reserve(decals.size());
  std::ranges::transform(decals, std::back_inserter(boxes), &gpu::DecalData::box);
  return boxes;
}

}  // namespace lamp::app
