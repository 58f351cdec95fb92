// SPDX-License-Identifier: Apache-2.0
#include "gpu/over_depth.h"

#include "render/pass_uses.h"

namespace lamp::app {

using Passes = vulkan::PlanRunner::Passes;

OverDepth::OverDepth(const View& view, const std::vector<float>& depth, const std::vector<shared::Light>& lights)
    : OverDepth(view, depth_image(view.width(), view.height(), depth), lights) {}

OverDepth::OverDepth(const View& view, GpuImage depth, const std::vector<shared::Light>& lights)
    : size_(view.width(), view.height()),
      depth_(std::move(depth)),
      data_(test_context().device(), static_cast<std::uint32_t>(lights.size())) {
  data_.set(view, lights);
}

std::vector<std::uint32_t> OverDepth::per_pixel(const std::string& shader, vulkan::PlanRunner& runner, Passes which) {
  const bool fused = which == Passes::fused;
  const vulkan::PlanInputs inputs = data_.plan_inputs(depth_.sampled());
  const vulkan::BoundLookUp lookup = runner.lookup(inputs, which);
  vulkan::PipelineInfo info{.name = shader, .constants = lookup.constants, .bindings = {{0}, {1}}};
  info.constants.push_back({0, fused ? runner.plan().fused->group_width : 8});
  info.constants.push_back({1, fused ? runner.plan().fused->group_height : 8});
  for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
  const vulkan::Pipeline pipeline = take(
      vulkan::Pipeline::compute(test_context().device(), info, test_shader(shader + "@" + std::string(lookup.name))));
  const vulkan::Buffer found = host_buffer("counts", std::size_t{size_.x} * size_.y * sizeof(std::uint32_t));
  std::vector<vulkan::Bound> bound = lookup.resources;
  bound.push_back({0, data_.frame()});
  bound.push_back({1, vulkan::Resource::storage(found.handle())});
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    tracker.assume(depth_.sampled());
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    data_.record_upload(recorder);
    static_cast<void>(take(runner.record(recorder, inputs, which)));
    std::vector<vulkan::Use> uses{{.resource = vulkan::Resource::storage(found.handle()),
                                   .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                   .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}};
    for (const vulkan::Bound& b : lookup.resources)
      uses.push_back(reads(b.resource, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
    recorder.begin_pass(shader, uses);
    recorder.bind(pipeline, bound);
    const std::uint32_t side_x = fused ? runner.plan().fused->group_width : 8;
    const std::uint32_t side_y = fused ? runner.plan().fused->group_height : 8;
    vkCmdDispatch(commands, (size_.x + side_x - 1) / side_x, (size_.y + side_y - 1) / side_y, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(vulkan::Resource::storage(found.handle()))});
  });
  return contents<std::uint32_t>(found);
}

}  // namespace lamp::app
