// Makes Cullers and records frames.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/flying.h"

namespace lamp::app {

std::vector<CullerCandidate> culler_candidates() {
  std::vector<CullerCandidate> all;
  for (const Method& method : methods()) all.push_back({method.name, {}});
  all.push_back({"drobot-zbin", {"sort=cpu"}});
  all.push_back({"tiled-bits", {"frusta=cached"}});
  return all;
}

vulkan::Culler culler_of(const CullerCandidate& candidate, std::uint32_t frames_in_flight) {
  vulkan::CullerInfo info = engine_culler_info(candidate.method, candidate.options);
  info.frames_in_flight = frames_in_flight;
  return take(vulkan::Culler::create(test_context().device(), info));
}

Masks masks_alone(const CullerCandidate& candidate, const EngineFrame& frame) {
  vulkan::Culler culler = culler_of(candidate, 1);
  return cull_and_walk(culler, frame);
}

Flying::Flying(vulkan::Culler& culler, const EngineFrame& frame)
    : pass(culler.lookup(), frame), commands([&](VkCommandBuffer buffer) {
        number = take(culler.record(buffer, culler_frame(frame)));
        pass.record(buffer, culler.lookup());
        MaskPass::record_to_host(buffer);
      }) {}

}  // namespace lamp::app
