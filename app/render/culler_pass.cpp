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
                                                   .brings_spheres = true}))) {}

void CullerPass::record(vulkan::Recorder& recorder, const LightingFrame& frame) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  std::vector<vulkan::Use> uses{reads(frame.data.lights(), COMPUTE), reads(frame.data.spheres(), COMPUTE)};
  std::vector<vulkan::CullerView> views;
  for (std::size_t i = 0; i < frame.views.size(); ++i) {
    const vulkan::Resource& depth = frame.inputs.depths[i];
    uses.push_back(reads(depth, COMPUTE));
    views.push_back({&frame.views[i], depth.image, depth.view, depth.layout});
  }
  recorder.begin_pass(NAME, uses);
  recorded_ = take(culler_.record(recorder.commands(), {.lights = frame.inputs.lights,
                                                        .spheres = frame.inputs.spheres,
                                                        .light_count = frame.data.entities().lights.count(),
                                                        .host_lights = frame.inputs.host_lights,
                                                        .views = views}));
  recorder.end_pass();
}

void CullerPass::finish() {
  if (recorded_ != 0) static_cast<void>(take(culler_.finish(std::exchange(recorded_, 0))));
}

}  // namespace lamp::app
