// Draws shadow maps with the hardware's rasterizer: the GPU finds which casters each view shows, and a batch of views
// is one indirect draw for all opaque casters and one for each masked material. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/mesh_pass.h"
#include "render/shadow_drawing.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t BINDING_VIEWS = 10;
constexpr std::uint32_t BINDING_CASTERS = 11;
constexpr std::uint32_t BINDING_PAIRS = 12;

void check_features(const Context& context) {
  VkPhysicalDeviceFeatures has{};
  vkGetPhysicalDeviceFeatures(context.device().physical, &has);
  const auto need = [&](VkBool32 feature, const char* name) {
    if (feature == VK_FALSE)
      throw Error(fmt::format("--shadows: device {} lacks the feature {}", context.row().name, name), Exit::no_device);
  };
  need(has.shaderClipDistance, "shaderClipDistance");
  need(has.multiDrawIndirect, "multiDrawIndirect");
  need(has.drawIndirectFirstInstance, "drawIndirectFirstInstance");
}

/// Whether clip distances hold in a pipeline without a fragment shader, as Vulkan has it. SwiftShader reads them with a
/// fragment's other inputs, and without a shader not at all: what lies outside of a light's square fills the atlas.
bool clips_without_fragments(VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  return driver.driverID != VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
}

VkClearRect clear_rect(const gpu::ShadowSquare& square) {
  return {.rect = {.offset = {static_cast<std::int32_t>(square.corner.x), static_cast<std::int32_t>(square.corner.y)},
                   .extent = {square.side, square.side}},
          .layerCount = 1};
}

vulkan::Resource storage(const vulkan::Buffer& buffer) { return vulkan::Resource::storage(buffer.handle()); }

GpuImageInfo depth_atlas(std::uint32_t size) {
  return {.name = "shadow atlas",
          .width = size,
          .height = size,
          .format = VK_FORMAT_D32_SFLOAT,
          .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                   VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
}

class ShadowDraws final : public ShadowDrawing {
 public:
  ShadowDraws(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowDrawingInfo& info);

 private:
  void make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders);
  void begin_atlas(VkCommandBuffer commands) const;
  void record_clears(vulkan::Recorder& recorder, std::span<const gpu::ShadowSquare> squares) override;
  void record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                    std::uint32_t count) override;
  void record_draws(vulkan::Recorder& recorder, const ShadowJob& job) const;

  bool cleared_ = false;  ///< all of the image, once
  vulkan::Buffer draw_template_;
  vulkan::Buffer draws_;
  vulkan::Pipeline cull_;
  vulkan::Pipeline opaque_;
  vulkan::Pipeline masked_;
};

ShadowDraws::ShadowDraws(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                         const ShadowDrawingInfo& info)
    : ShadowDrawing(context, scene, info, depth_atlas(info.atlas_size)) {
  check_features(context);
  draw_template_ =
      upload_buffer(context, "shadow draws without views", bytes_of(casters_.draws), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  draws_ = shadow_buffer(context.device(), "shadow draws", casters_.draws.size() * sizeof(gpu::ShadowDraw),
                         VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  make_pipelines(context.device(), shaders);
}

void ShadowDraws::make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders) {
  cull_ = pair_pipeline(device, shaders, "shadow_cull");
  vulkan::GraphicsState state = mesh_state(VK_COMPARE_OP_GREATER, {});
  std::erase_if(state.attributes,
                [](const auto& attribute) { return attribute.location == 1 || attribute.location == 2; });
  state.dynamic_cull = false;  // both sides: what is closed casts the same, what is a sheet is seen from both
  state.depth_clamp = true;
  vulkan::PipelineInfo draw{.name = "shadow maps, opaque", .constants = {{0, views_a_batch_}}};
  for (const std::uint32_t binding : {2U, BINDING_VIEWS, BINDING_CASTERS, BINDING_PAIRS})
    draw.bindings.push_back({binding});
  std::vector<std::uint32_t> fragments;
  if (!clips_without_fragments(device.physical)) fragments = shaders.spirv("shadow_opaque");
  opaque_ = take(vulkan::Pipeline::graphics(device, draw, shaders.spirv("shadow"), fragments, state));
  draw.name = "shadow maps, masked";
  draw.bindings.push_back({1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
  for (std::uint32_t i = 5; i < 10; ++i) draw.bindings.push_back({i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
  masked_ = take(vulkan::Pipeline::graphics(device, draw, shaders.spirv("shadow"), shaders.spirv("depth"), state));
}

void ShadowDraws::begin_atlas(VkCommandBuffer commands) const {
  const VkRect2D area{.extent = {atlas_.info().width, atlas_.info().height}};
  const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = atlas_.view(),
                                        .imageLayout = atlas_.attachment().layout,
                                        .loadOp = cleared_ ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRenderingInfo info{
      .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1, .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands, &info);
  const auto side = static_cast<float>(atlas_.info().width);
  const VkViewport viewport{.width = side, .height = side, .maxDepth = 1.0F};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
}

void ShadowDraws::record_clears(vulkan::Recorder& recorder, std::span<const gpu::ShadowSquare> squares) {
  if (cleared_ && squares.empty()) return;
  std::vector<VkClearRect> clears;
  if (cleared_) std::ranges::transform(squares, std::back_inserter(clears), clear_rect);
  recorder.barrier({draws_depth(atlas_, cleared_ ? Load::keep : Load::clear)});
  begin_atlas(recorder.commands());
  const VkClearAttachment far_away{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT};
  if (!clears.empty())
    vkCmdClearAttachments(recorder.commands(), 1, &far_away, static_cast<std::uint32_t>(clears.size()), clears.data());
  vkCmdEndRendering(recorder.commands());
  cleared_ = true;
}

void ShadowDraws::record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                               std::uint32_t count) {
  record_pairs(recorder, cull_, draw_template_, draws_, job, first_view, count);
  recorder.barrier({{.resource = storage(draws_),
                     .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                     .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
                    reads(storage(pairs_), GRAPHICS_SHADERS),
                    reads(job.views, GRAPHICS_SHADERS),
                    draws_depth(atlas_, Load::keep)});
  begin_atlas(recorder.commands());
  record_draws(recorder, job);
  vkCmdEndRendering(recorder.commands());
}

void ShadowDraws::record_draws(vulkan::Recorder& recorder, const ShadowJob& job) const {
  scene_.bind_geometry(recorder.commands());
  const std::vector<vulkan::Bound> shared_bound{{2, scene_.instances()},
                                                {BINDING_VIEWS, job.views},
                                                {BINDING_CASTERS, storage(caster_buffer_)},
                                                {BINDING_PAIRS, storage(pairs_)}};
  for (const ShadowCasters::Group& group : casters_.groups) {
    std::vector<vulkan::Bound> bound = shared_bound;
    if (group.masked) {
      const auto of_material = scene_.material_bound(group.material);
      bound.insert(bound.end(), of_material.begin(), of_material.end());
    }
    recorder.bind(group.masked ? masked_ : opaque_, bound);
    vkCmdDrawIndexedIndirect(recorder.commands(), draws_.handle(), group.first * sizeof(gpu::ShadowDraw), group.count,
                             sizeof(gpu::ShadowDraw));
  }
}

}  // namespace

std::unique_ptr<ShadowDrawing> shadow_draws(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                                            const ShadowDrawingInfo& info) {
  return std::make_unique<ShadowDraws>(context, shaders, scene, info);
}

}  // namespace lamp::app
