// Hands a frame's inputs to a Culler.
// SPDX-License-Identifier: Apache-2.0
#include "render/culler_pass.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "gpu/check.h"
#include "render/lighting.h"

namespace lamp::app {
namespace {

std::vector<std::string> words_of(const Options& options) {
  std::vector<std::string> words;
  for (const auto& [key, value] : options.all()) words.push_back(fmt::format("{}={}", key, value));
  return words;
}

}  // namespace

CullerPass::CullerPass(const vulkan::Device& device, const LightingInfo& info)
    : culler_(take(vulkan::Culler::create(device, {.width = info.width,
                                                   .height = info.height,
                                                   .views = info.depth.views,
                                                   .light_capacity = info.light_capacity,
                                                   .method = std::string(info.method->name),
                                                   .options = words_of(info.options),
                                                   .depth_samples = info.depth.samples,
                                                   .brings_spheres = true,
                                                   .host_barriers = info.host == Host::host_barriers}))),
      host_barriers_(info.host == Host::host_barriers) {}

void CullerPass::record(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (host_barriers_) recorder.order_with_next(culler_.barrier_before());
  const VkPipelineStageFlags2 stages =
      host_barriers_ ? culler_.barrier_before().dstStageMask : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  std::vector<vulkan::Use> uses{reads(frame.data.lights(), stages), reads(frame.data.spheres(), stages)};
  std::vector<vulkan::CullerView> views;
  for (std::size_t i = 0; i < frame.views.size(); ++i) {
    const vulkan::Resource& depth = frame.inputs.depths[i];
    uses.push_back(reads(depth, stages));
    views.push_back({&frame.views[i], depth.image, depth.view, depth.layout});
  }
  recorder.begin_pass(NAME, uses);
  recorded_ = take(culler_.record(recorder.commands(), {.lights = frame.inputs.lights,
                                                        .spheres = frame.inputs.spheres,
                                                        .light_count = frame.data.entities().lights.count(),
                                                        .host_lights = frame.inputs.host_lights,
                                                        .views = views}));
  recorder.end_pass();
  if (host_barriers_) recorder.order_with_next(culler_.barrier_behind());
}

void CullerPass::finish() {
  if (recorded_ != 0) static_cast<void>(take(culler_.finish(std::exchange(recorded_, 0))));
}

}  // namespace lamp::app
