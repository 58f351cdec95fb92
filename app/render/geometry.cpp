// Records depth and G-buffer.
// SPDX-License-Identifier: Apache-2.0
#include "render/geometry.h"

#include "gpu/check.h"

namespace lamp::app {
namespace {

std::vector<vulkan::Use> with_frame(std::vector<vulkan::Use> uses, const FrameData& frame) {
  uses.push_back(reads(frame.frame(), GRAPHICS_SHADERS));
  return uses;
}

}  // namespace

Geometry::Geometry(const vulkan::Device& device, const ShaderLibrary& shaders, const HostDepth& depth) : depth_(depth) {
  const auto make = [&](const char* name, const char* fragment, std::vector<VkFormat> colors) {
    const vulkan::PipelineInfo info{.name = name, .bindings = mesh_bindings()};
    const std::vector<std::uint32_t> code =
        fragment == nullptr ? std::vector<std::uint32_t>() : shaders.spirv(fragment);
    return take(vulkan::Pipeline::graphics(device, info, shaders.spirv("mesh"), code,
                                           mesh_state(depth.nearer(), std::move(colors))));
  };
  depth_opaque_ = make("depth, opaque", nullptr, {});
  depth_masked_ = make("depth, masked", "depth", {});
  gbuffer_ =
      make("g-buffer", "gbuffer", {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R32G32_UINT, VK_FORMAT_R16G16B16A16_SFLOAT});
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
  const Attachments attachments{
      .colors = {{&targets.base_color, Load::clear}, {&targets.surface, Load::clear}, {&targets.emission, Load::clear}},
      .depth = &targets.depth,
      .sky = depth_.sky()};
  recorder.begin_pass("g-buffer", with_frame(attachment_uses(attachments), frame));
  begin_rendering(recorder.commands(), attachments, targets);
  draw_meshes(recorder, {.scene = &scene, .frame = &frame, .draws = scene.opaque(), .pipeline = &gbuffer_});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

}  // namespace lamp::app
