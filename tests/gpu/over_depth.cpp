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
  data_.set({&view, 1}, lights);
}

std::vector<std::uint32_t> OverDepth::per_pixel(const std::string& shader, vulkan::PlanRunner& runner, Passes which) {
  return per_pixel(std::vector{shader}, runner, which, 1).front();
}

std::vector<std::vector<std::uint32_t>> OverDepth::per_pixel(const std::vector<std::string>& shaders,
                                                             vulkan::PlanRunner& runner, Passes which,
                                                             std::uint32_t words) {
  const vulkan::Resource depth = depth_.sampled();
  data_.take_cells_of(runner.plan());
  const vulkan::PlanInputs inputs = data_.plan_inputs({&depth, 1});
  const vulkan::BoundLookUp lookup = runner.lookup(inputs, which);
  const bool fused = which == Passes::fused;
  const glm::uvec2 group =
      fused ? glm::uvec2(runner.plan().fused->group_width, runner.plan().fused->group_height) : glm::uvec2(8);
  std::vector<vulkan::Pipeline> pipelines;
  std::vector<vulkan::Buffer> found;
  for (const std::string& shader : shaders) {
    vulkan::PipelineInfo info{.name = shader, .constants = lookup.constants, .bindings = {{0}, {1}}};
    info.constants.push_back({0, group.x});
    info.constants.push_back({1, group.y});
    for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
    pipelines.push_back(take(vulkan::Pipeline::compute(test_context().device(), info,
                                                       test_shader(shader + "@" + std::string(lookup.name)))));
    found.push_back(host_buffer("words of " + shader, std::size_t{size_.x} * size_.y * words * sizeof(std::uint32_t)));
  }
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    tracker.assume(depth_.sampled());
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    data_.record_upload(recorder);
    static_cast<void>(take(runner.record(recorder, inputs, which)));
    for (std::size_t i = 0; i < shaders.size(); ++i) {
      const vulkan::Resource to = vulkan::Resource::storage(found[i].handle());
      std::vector<vulkan::Bound> bound = lookup.resources;
      bound.push_back({0, data_.frame()});
      bound.push_back({1, to});
      std::vector<vulkan::Use> uses{{.resource = to,
                                     .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                     .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}};
      for (const vulkan::Bound& b : lookup.resources)
        uses.push_back(reads(b.resource, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
      recorder.begin_pass(shaders[i], uses);
      recorder.bind(pipelines[i], bound);
      vkCmdDispatch(commands, (size_.x + group.x - 1) / group.x, (size_.y + group.y - 1) / group.y, 1);
      recorder.end_pass();
      recorder.barrier({host_reads(to)});
    }
  });
  std::vector<std::vector<std::uint32_t>> values;
  for (const vulkan::Buffer& buffer : found) values.push_back(contents<std::uint32_t>(buffer));
  return values;
}

}  // namespace lamp::app
