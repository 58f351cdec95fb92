// A pipeline of its own each time: hosts ask seldom.
// SPDX-License-Identifier: Apache-2.0
#include "render/answers.h"

#include <algorithm>

#include "gpu/check.h"
#include "render/pass_uses.h"

namespace lamp::app {

vulkan::Buffer run_for_answers(Renderer& renderer, const ShaderLibrary& shaders, AnswersPass pass, std::size_t bytes) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  vulkan::Buffer answers = readback_buffer(renderer.device(), pass.shader, bytes);
  const vulkan::Resource written = vulkan::Resource::storage(answers.handle());
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : pass.bound)
    if (std::ranges::none_of(uses, [&](const vulkan::Use& use) {
          return use.resource.buffer == b.resource.buffer && use.resource.image == b.resource.image;
        }))
      uses.push_back(reads(b.resource, COMPUTE));
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  pass.bound.push_back({pass.answers_at, written});
  const auto push_bytes = static_cast<std::uint32_t>(pass.push.size());
  vulkan::PipelineInfo info{.name = pass.shader, .constants = pass.constants, .push_constant_bytes = push_bytes};
  for (const vulkan::Bound& b : pass.bound) info.bindings.push_back({b.binding, b.resource.type});
  const vulkan::Pipeline pipeline =
      take(vulkan::Pipeline::compute(renderer.device(), info, shaders.spirv(pass.shader)));
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass(pass.shader, uses);
    recorder.bind(pipeline, pass.bound);
    if (push_bytes != 0)
      vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, push_bytes, pass.push.data());
    vkCmdDispatch(recorder.commands(), pass.groups.x, pass.groups.y, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(answers);
  return answers;
}

}  // namespace lamp::app
