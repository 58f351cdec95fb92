// Records depth and G-buffer.
// SPDX-License-Identifier: Apache-2.0
#include "render/geometry.h"

#include <array>

#include "gpu/check.h"

namespace lamp::app {
namespace {

std::vector<vulkan::Use> with_frame(std::vector<vulkan::Use> uses, const FrameData& frame) {
  uses.push_back(reads(frame.frame(), GRAPHICS_SHADERS));
  return uses;
}

struct GeometryPipeline {
  const char* name = nullptr;
  const char* fragment = nullptr;
  std::vector<VkFormat> colors;
};

vulkan::Pipeline make_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const HostDepth& depth,
                               GeometryPipeline of) {
  const vulkan::PipelineInfo info{.name = of.name, .bindings = mesh_bindings()};
  const std::vector<std::uint32_t> code =
      of.fragment == nullptr ? std::vector<std::uint32_t>() : shaders.spirv(of.fragment);
  return take(vulkan::Pipeline::graphics(device, info, shaders.spirv("mesh"), code,
                                         mesh_state(depth.nearer(), std::move(of.colors))));
}

constexpr std::array<VkFormat, 4> GBUFFER{VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R32G32_UINT, VK_FORMAT_R16G16B16A16_SFLOAT,
                                          VK_FORMAT_R32_UINT};  // the last: of triangles

}  // namespace

Geometry::Geometry(const vulkan::Device& device, const ShaderLibrary& shaders, const HostDepth& depth)
    : depth_(depth),
      depth_opaque_(make_pipeline(device, shaders, depth, {.name = "depth, opaque"})),
      depth_masked_(make_pipeline(device, shaders, depth, {.name = "depth, masked", .fragment = "depth"})),
      gbuffer_(
          make_pipeline(device, shaders, depth,
                        {.name = "g-buffer", .fragment = "gbuffer", .colors = {GBUFFER.begin(), GBUFFER.end() - 1}})) {}

void Geometry::need_triangles(const vulkan::Device& device, const ShaderLibrary& shaders) {
  if (gbuffer_triangles_) return;
  gbuffer_triangles_ = make_pipeline(
      device, shaders, depth_,
      {.name = "g-buffer, triangles", .fragment = "gbuffer_triangles", .colors = {GBUFFER.begin(), GBUFFER.end()}});
}

std::vector<vulkan::Pipeline> Geometry::pipelines() const {
  std::vector<vulkan::Pipeline> all{depth_opaque_, depth_masked_, gbuffer_};
  if (gbuffer_triangles_) all.push_back(*gbuffer_triangles_);
  return all;
}

void Geometry::record_depth(vulkan::Recorder& recorder, const GpuScene& scene, const FrameData& frame,
                            const Targets& targets) const {
  if (scene.captured() != nullptr) return scene.captured()->record(recorder, targets);
  const Attachments attachments{.depth = &targets.depth, .sky = depth_.sky()};
  recorder.begin_pass("depth pre-pass", with_frame(attachment_uses(attachments), frame));
  begin_rendering(recorder.commands(), attachments, targets);
  draw_meshes(recorder, {.scene = &scene,
                         .frame = &frame,
                         .draws = scene.opaque(),
                         .pipeline = &depth_masked_,
                         .opaque_pipeline = &depth_opaque_});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

void Geometry::record_gbuffer(vulkan::Recorder& recorder, const GpuScene& scene, const FrameData& frame,
                              const Targets& targets) const {
  if (scene.captured() != nullptr) return scene.captured()->record(recorder, targets);
  Attachments attachments{
      .colors = {{&targets.base_color, Load::clear}, {&targets.surface, Load::clear}, {&targets.emission, Load::clear}},
      .depth = &targets.depth,
      .sky = depth_.sky()};
  if (targets.numbered) attachments.colors.push_back({&targets.triangles, Load::clear});
  recorder.begin_pass("g-buffer", with_frame(attachment_uses(attachments), frame));
  begin_rendering(recorder.commands(), attachments, targets);
  draw_meshes(recorder, {.scene = &scene,
                         .frame = &frame,
                         .draws = scene.opaque(),
                         .pipeline = targets.numbered ? &*gbuffer_triangles_ : &gbuffer_});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

}  // namespace lamp::app
