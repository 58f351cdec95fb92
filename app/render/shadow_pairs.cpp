// Asks the shader of pairs.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_pairs.h"

#include "gpu/transfer.h"
#include "render/answers.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP = 64;  // threads of shadow_pairs.comp

}  // namespace

std::vector<gpu::ShadowAnswer> ask_shadows(Renderer& renderer, const ShaderLibrary& shaders,
                                           std::span<const gpu::ShadowPair> pairs, ShadowAsked asked_for) {
  if (pairs.empty()) return {};
  const Targets& targets = renderer.targets();
  renderer.make_reach(ShadowReach::Kind::radial);
  const vulkan::Buffer* radial = renderer.shadows()->reach(ShadowReach::Kind::radial);
  std::vector<gpu::ShadowPair> of_records(pairs.begin(), pairs.end());
  for (gpu::ShadowPair& pair : of_records) pair.light = renderer.record_of(pair.light);
  const vulkan::Buffer asked = upload_buffer(renderer.context(), "pairs of pixel and light", bytes_of(of_records),
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  AnswersPass pass{.shader = "shadow_pairs",
                   .constants = {shadow_constant(renderer.shadows()->settings().filter)},
                   .bound = {{0, renderer.data().frame_constants()},
                             {1, targets.depth.sampled()},
                             {2, vulkan::Resource::storage(asked.handle())},
                             {3, renderer.data().lights()},
                             {5, targets.base_color.sampled()},
                             {6, targets.surface.sampled()},
                             {9, vulkan::Resource::storage(radial->handle())},
                             {10, renderer.light_meshes()}},
                   .answers_at = 8};
  for (const vulkan::Bound& b : renderer.shadow_bound()) pass.bound.push_back(b);
  const gpu::ShadowQuestion question{.pairs = static_cast<std::uint32_t>(pairs.size()),
                                     .texels = asked_for == ShadowAsked::texels ? 1U : 0U};
  pass.push = std::as_bytes(std::span(&question, 1));
  pass.groups.x = (question.pairs + GROUP - 1) / GROUP;
  std::vector<gpu::ShadowAnswer> found =
      answers_of<gpu::ShadowAnswer>(renderer, shaders, std::move(pass), pairs.size());
  renderer.forget(asked);
  return found;
}

}  // namespace lamp::app
