// Asks the shader of pairs.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_pairs.h"

#include "gpu/check.h"
#include "gpu/transfer.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP = 64;  // threads of shadow_pairs.comp

}  // namespace

std::vector<gpu::ShadowAnswer> ask_shadows(Renderer& renderer, const ShaderLibrary& shaders,
                                           std::span<const gpu::ShadowPair> pairs, ShadowAsked asked_for) {
  if (pairs.empty()) return {};
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const Targets& targets = renderer.targets();
  renderer.make_reach(ShadowReach::Kind::radial);
  const vulkan::Buffer* radial = renderer.shadows()->reach(ShadowReach::Kind::radial);
  const vulkan::Buffer asked = upload_buffer(renderer.context(), "pairs of pixel and light", std::as_bytes(pairs),
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Buffer answers =
      readback_buffer(renderer.device(), "shadow answers", pairs.size() * sizeof(gpu::ShadowAnswer));
  const vulkan::Resource written = vulkan::Resource::storage(answers.handle());
  std::vector<vulkan::Bound> bound{{0, renderer.data().frame_constants()},
                                   {1, targets.depth.sampled()},
                                   {2, vulkan::Resource::storage(asked.handle())},
                                   {3, renderer.data().lights()},
                                   {5, targets.base_color.sampled()},
                                   {6, targets.surface.sampled()},
                                   {9, vulkan::Resource::storage(radial->handle())},
                                   {10, renderer.light_meshes()}};
  for (const vulkan::Bound& b : renderer.shadow_bound()) bound.push_back(b);
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, COMPUTE));
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  bound.push_back({8, written});
  vulkan::PipelineInfo info{.name = "shadow pairs",
                            .constants = {shadow_constant(renderer.shadows()->settings().filter)},
                            .push_constant_bytes = sizeof(gpu::ShadowQuestion)};
  for (const vulkan::Bound& b : bound) info.bindings.push_back({b.binding, b.resource.type});
  const vulkan::Pipeline pipeline =
      take(vulkan::Pipeline::compute(renderer.device(), info, shaders.spirv("shadow_pairs")));
  const gpu::ShadowQuestion question{.pairs = static_cast<std::uint32_t>(pairs.size()),
                                     .texels = asked_for == ShadowAsked::texels ? 1U : 0U};
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass("shadow pairs", uses);
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(question), &question);
    vkCmdDispatch(recorder.commands(), (question.pairs + GROUP - 1) / GROUP, 1, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(asked);
  renderer.forget(answers);
  return first_values<gpu::ShadowAnswer>(answers, pairs.size());
}

}  // namespace lamp::app
