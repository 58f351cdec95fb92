// Records the renderer's dispatches over pixels.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/check.h"
#include "render/renderer.h"

namespace lamp::app {
namespace {

bool is_fused(const PixelPass& pass) {
  return pass.lighting != nullptr && pass.which == vulkan::PlanRunner::Passes::fused;
}

/// A fused look-up's group is its tile.
glm::uvec2 group_of(const PixelPass& pass) {
  if (!is_fused(pass)) return glm::uvec2(pass.group_px);
  const FusedLookUp& fused = *pass.lighting->runner().plan().fused;
  return {fused.group_width, fused.group_height};
}

}  // namespace

vulkan::Pipeline Renderer::pixel_pipeline(const PixelPass& pass) const {
  vulkan::PipelineInfo info{.name = std::string(pass.shader),
                            .push_constant_bytes = static_cast<std::uint32_t>(pass.push.size() * sizeof(pass.push[0]))};
  info.bindings = {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}};
  for (const PixelPass::Storage& storage : pass.storage)
    info.bindings.push_back({storage.binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  for (const vulkan::Bound& b : pass.bound) info.bindings.push_back({b.binding, b.resource.type});
  if (pass.lighting == nullptr)
    return take(vulkan::Pipeline::compute(context_.device(), info, shaders_.spirv(pass.shader)));
  const Plan& plan = pass.lighting->runner().plan();
  const LookUp& lookup = is_fused(pass) ? plan.fused->lookup : plan.lookup;
  info.constants = vulkan::lookup_constants(lookup);
  info.constants.insert(info.constants.end(), pass.constants.begin(), pass.constants.end());
  info.constants.push_back(shown_view_constant(plan));
  const glm::uvec2 group_px = group_of(pass);
  info.constants.push_back({0, group_px.x});
  info.constants.push_back({1, group_px.y});
  for (const vulkan::DescriptorBinding& binding : vulkan::lookup_bindings(lookup)) info.bindings.push_back(binding);
  return take(vulkan::Pipeline::compute(context_.device(), info,
                                        shaders_.spirv(fmt::format("{}@{}", pass.shader, lookup.name))));
}

void Renderer::run(const PixelPass& pass, const vulkan::Pipeline& pipeline) {
  if (depth_.several()) need_surfaces();  // of the picture that is shown; the targets may have another's
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const glm::uvec2 group_px = group_of(pass);
  const std::uint32_t rows = is_fused(pass) || pass.rows.count == 0 ? targets_->height : pass.rows.count;
  submit(pass.lighting, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    if (pass.prepares) record_upload(recorder);
    if (pass.prepares && pass.lighting != nullptr) record_reach(recorder, *pass.lighting);
    const vulkan::PlanInputs inputs = plan_inputs();
    if (pass.prepares && pass.lighting != nullptr)
      static_cast<void>(take(pass.lighting->runner().record(recorder, inputs, pass.which)));
    for (const PixelPass::Storage& storage : pass.storage) {
      if (!storage.zeroed) continue;
      recorder.barrier({{.resource = storage.resource,
                         .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                         .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
      vkCmdFillBuffer(commands, storage.resource.buffer, 0, VK_WHOLE_SIZE, 0);
    }
    std::vector<vulkan::Bound> bound{{0, data_.frame()}, {1, targets_->depth.sampled()}};
    std::vector<vulkan::Use> uses{reads(data_.frame(), COMPUTE), reads(targets_->depth.sampled(), COMPUTE)};
    for (const PixelPass::Storage& storage : pass.storage) {
      bound.push_back({storage.binding, storage.resource});
      uses.push_back({.resource = storage.resource, .stages = COMPUTE, .access = storage.access});
    }
    for (const vulkan::Bound& b : pass.bound) {
      bound.push_back(b);
      uses.push_back(reads(b.resource, COMPUTE));
    }
    if (pass.lighting != nullptr) {
      const vulkan::BoundLookUp lookup = pass.lighting->runner().lookup(inputs, pass.which, shown_.view);
      bound.insert(bound.end(), lookup.resources.begin(), lookup.resources.end());
      uses.insert(uses.end(), lookup.uses.begin(), lookup.uses.end());
    }
    recorder.begin_pass(pass.shader, uses);
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(commands, pipeline.layout(), VK_SHADER_STAGE_ALL, 0,
                       static_cast<std::uint32_t>(pass.push.size() * sizeof(pass.push[0])), pass.push.data());
    vkCmdDispatch(commands, (targets_->width + group_px.x - 1) / group_px.x, (rows + group_px.y - 1) / group_px.y, 1);
    recorder.end_pass();
    for (const PixelPass::Storage& storage : pass.storage)
      if ((storage.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0)
        recorder.barrier({host_reads(storage.resource)});
  });
}

}  // namespace lamp::app
