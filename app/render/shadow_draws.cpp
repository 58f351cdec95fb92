// Draws shadow maps with the hardware's rasterizer: the GPU finds which casters each view shows, and a set of views,
// each a viewport with a scissor of its own, is one indirect draw for all opaque casters and one for each masked
// material.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
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

void check_device(const Context& context, std::size_t casters) {
  vulkan::RequiredFeatures has(VK_FALSE);
  vkGetPhysicalDeviceFeatures2(context.device().physical, &has.base);
  const auto need = [&](VkBool32 feature, const char* name) {
    if (feature == VK_FALSE)
      throw Error(fmt::format("--shadow-raster hardware: device {} lacks the feature {}; expected compute or auto",
                              context.row().name, name),
                  Exit::no_device);
  };
  need(has.base.features.shaderClipDistance, "shaderClipDistance");
  need(has.base.features.multiViewport, "multiViewport");
  need(has.base.features.multiDrawIndirect, "multiDrawIndirect");
  need(has.base.features.drawIndirectFirstInstance, "drawIndirectFirstInstance");
  need(has.vulkan12.shaderOutputViewportIndex, "shaderOutputViewportIndex");
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(context.device().physical, &properties);
  if (casters > properties.limits.maxDrawIndirectCount)
    throw Error(fmt::format("--shadow-raster hardware: the scene has {} pieces of meshes that cast shadows, device {} "
                            "draws {} at once; expected compute or auto",
                            casters, context.row().name, properties.limits.maxDrawIndirectCount),
                Exit::no_device);
}

VkRect2D rect_of(const ShadowSquare& square) {
  return {.offset = {static_cast<std::int32_t>(square.corner.x), static_cast<std::int32_t>(square.corner.y)},
          .extent = {square.side, square.side}};
}

VkClearRect clear_rect(const ShadowSquare& square) { return {.rect = rect_of(square), .layerCount = 1}; }

/// Those that are not needed stay as the first.
void set_viewports(VkCommandBuffer commands, std::span<const ShadowSquare> views) {
  std::array<VkViewport, gpu::VIEWS_A_DRAW> viewports{};
  std::array<VkRect2D, gpu::VIEWS_A_DRAW> scissors{};
  for (std::size_t i = 0; i < scissors.size(); ++i) {
    scissors[i] = rect_of(views[i < views.size() ? i : 0]);
    viewports[i] = {.x = static_cast<float>(scissors[i].offset.x),
                    .y = static_cast<float>(scissors[i].offset.y),
                    .width = static_cast<float>(scissors[i].extent.width),
                    .height = static_cast<float>(scissors[i].extent.height),
                    .maxDepth = 1.0F};
  }
  vkCmdSetViewport(commands, 0, gpu::VIEWS_A_DRAW, viewports.data());
  vkCmdSetScissor(commands, 0, gpu::VIEWS_A_DRAW, scissors.data());
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
  void record_start(vulkan::Recorder& recorder, const ShadowJob& job) override;
  void record_clears(vulkan::Recorder& recorder, std::span<const ShadowSquare> squares);
  void record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                    std::uint32_t count) override;
  void record_set(vulkan::Recorder& recorder, std::uint32_t set, std::uint32_t first_view) const;

  bool cleared_ = false;         ///< all of the image, once
  vulkan::Buffer caster_draws_;  ///< gpu::ShadowDraw of each caster
  vulkan::Buffer draws_;         ///< the same in each set of views
  vulkan::Buffer views_;         ///< shared::ShadowView, each for its own viewport
  vulkan::Pipeline cull_;
  vulkan::Pipeline opaque_;
  vulkan::Pipeline masked_;
};

ShadowDraws::ShadowDraws(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                         const ShadowDrawingInfo& info)
    : ShadowDrawing(context, scene, info, depth_atlas(info.atlas_size)) {
  check_device(context, casters_.casters.size());
  const std::uint32_t sets = views_a_batch_ / gpu::VIEWS_A_DRAW;
  caster_draws_ =
      upload_buffer(context, "shadow casters' triangles", bytes_of(casters_.draws), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  draws_ = shadow_buffer(context.device(), "shadow draws", sets * casters_.draws.size() * sizeof(gpu::ShadowDraw),
                         VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  views_ = take(vulkan::Buffer::create(
      context.device(), {.name = "shadow views of viewports",
                         .bytes = std::max<std::uint64_t>(1, info.most_views) * sizeof(shared::ShadowView),
                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                         .memory = vulkan::MemoryUse::upload}));
  make_pipelines(context.device(), shaders);
}

void ShadowDraws::make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders) {
  cull_ = pair_pipeline(device, shaders, "shadow_cull", {3, 5});
  vulkan::GraphicsState state = mesh_state(VK_COMPARE_OP_GREATER, {});
  std::erase_if(state.attributes,
                [](const auto& attribute) { return attribute.location == 1 || attribute.location == 2; });
  state.dynamic_cull = false;  // both sides: what is closed casts the same, what is a sheet is seen from both
  state.depth_clamp = true;
  state.viewports = gpu::VIEWS_A_DRAW;
  vulkan::PipelineInfo draw{.name = "shadow maps, opaque", .push_constant_bytes = sizeof(std::uint32_t)};
  for (const std::uint32_t binding : {2U, BINDING_VIEWS, BINDING_CASTERS, BINDING_PAIRS})
    draw.bindings.push_back({binding});
  opaque_ = take(vulkan::Pipeline::graphics(device, draw, shaders.spirv("shadow"), {}, state));
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
}

void ShadowDraws::record_start(vulkan::Recorder& recorder, const ShadowJob& job) {
  record_clears(recorder, job.squares);
  auto* const own = reinterpret_cast<shared::ShadowView*>(views_.mapped().data());
  for (std::size_t i = 0; i < job.host_views.size(); ++i)
    own[i] = shadow_view_in(job.host_views[i], job.viewports[i], atlas_.info().width);
}

void ShadowDraws::record_clears(vulkan::Recorder& recorder, std::span<const ShadowSquare> squares) {
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
  recorder.barrier({changes(storage(draws_))});
  const std::array<vulkan::Bound, 2> draws{{{3, storage(caster_draws_)}, {5, storage(draws_)}}};
  record_pairs(recorder, cull_, draws, job, first_view, count, gpu::VIEWS_A_DRAW);
  recorder.barrier({{.resource = storage(draws_),
                     .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                     .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
                    reads(storage(pairs_), GRAPHICS_SHADERS),
                    reads(storage(views_), GRAPHICS_SHADERS),
                    draws_depth(atlas_, Load::keep)});
  begin_atlas(recorder.commands());
  scene_.bind_geometry(recorder.commands());
  for (std::uint32_t at = 0; at < count; at += gpu::VIEWS_A_DRAW) {
    set_viewports(recorder.commands(), job.viewports.subspan(first_view + at, std::min(gpu::VIEWS_A_DRAW, count - at)));
    record_set(recorder, at / gpu::VIEWS_A_DRAW, first_view + at);
  }
  vkCmdEndRendering(recorder.commands());
}

void ShadowDraws::record_set(vulkan::Recorder& recorder, std::uint32_t set, std::uint32_t first_view) const {
  const std::vector<vulkan::Bound> shared_bound{{2, scene_.instances()},
                                                {BINDING_VIEWS, storage(views_)},
                                                {BINDING_CASTERS, storage(caster_buffer_)},
                                                {BINDING_PAIRS, storage(pairs_)}};
  for (const ShadowCasters::Group& group : casters_.groups) {
    std::vector<vulkan::Bound> bound = shared_bound;
    if (group.masked) {
      const auto of_material = scene_.material_bound(group.material);
      bound.insert(bound.end(), of_material.begin(), of_material.end());
    }
    const vulkan::Pipeline& pipeline = group.masked ? masked_ : opaque_;
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(first_view), &first_view);
    const std::size_t first = set * casters_.casters.size() + group.first;
    vkCmdDrawIndexedIndirect(recorder.commands(), draws_.handle(), first * sizeof(gpu::ShadowDraw), group.count,
                             sizeof(gpu::ShadowDraw));
  }
}

}  // namespace

std::unique_ptr<ShadowDrawing> shadow_draws(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                                            const ShadowDrawingInfo& info) {
  return std::make_unique<ShadowDraws>(context, shaders, scene, info);
}

}  // namespace lamp::app
