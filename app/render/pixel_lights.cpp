// One dispatch over the picture for the walk, of which one thread works; one over the lights for the terms.
// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_lights.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t TERM_GROUP = 64;           // threads of light_shares.comp
constexpr std::uint32_t CONSTANT_REFLECTION = 10;  // common/brdf.glsl

vulkan::Buffer read_back(const vulkan::Device& device, const char* name, std::uint64_t bytes) {
  return take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = std::max<std::uint64_t>(bytes, 16),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                      .memory = vulkan::MemoryUse::readback}));
}

}  // namespace

std::vector<std::uint32_t> lights_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel) {
  const EntityRange lights = renderer.entities().lights;
  const std::uint32_t words = (lights.count() + 31) / 32;
  const vulkan::Buffer marks = read_back(renderer.device(), "marks of a pixel", words * sizeof(std::uint32_t));
  renderer.run({.shader = "visit_marks",
                .lighting = &lighting,
                .storage = {{2, vulkan::Resource::storage(marks.handle()),
                             VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                             /*zeroed=*/true}},
                .push = {pixel, pixel + 1, lights.first, lights.end, lights.end}});
  renderer.forget(marks);
  std::vector<std::uint32_t> found(words);
  if (words != 0) std::memcpy(found.data(), marks.mapped().data(), words * sizeof(std::uint32_t));
  std::vector<std::uint32_t> ids;
  for (std::uint32_t bit = 0; bit < lights.count(); ++bit)
    if ((found[bit / 32] >> bit % 32 & 1U) != 0) ids.push_back(lights.first + bit);
  return ids;
}

PixelTerms terms_at(Renderer& renderer, const ShaderLibrary& shaders, const GpuScene& scene, const LightingInfo& info,
                    std::uint32_t pixel, std::span<const std::uint32_t> lights) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  if (info.path == ShadingPath::forward) renderer.need_surfaces();
  const Targets& targets = renderer.targets();
  const FrameData& data = renderer.data();
  const vulkan::Device& device = renderer.device();
  const vulkan::Buffer ids =
      upload_buffer(renderer.context(), "lights of a pixel", std::as_bytes(lights), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Buffer terms = read_back(device, "terms of a pixel", (lights.size() + 1) * sizeof(glm::vec4));
  const vulkan::Resource read = vulkan::Resource::storage(ids.handle());
  const vulkan::Resource written = vulkan::Resource::storage(terms.handle());
  const std::vector<vulkan::Bound> bound{{0, data.frame_constants()},
                                         {1, targets.depth.sampled()},
                                         {2, read},
                                         {3, data.lights()},
                                         {4, scene.surroundings()},
                                         {5, targets.base_color.sampled()},
                                         {6, targets.surface.sampled()},
                                         {7, targets.emission.sampled()},
                                         {8, written}};
  vulkan::PipelineInfo pipeline{.name = "light shares",
                                .constants = {{CONSTANT_REFLECTION, static_cast<std::uint32_t>(info.brdf)}},
                                .push_constant_bytes = 3 * sizeof(std::uint32_t)};
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) {
    pipeline.bindings.push_back({b.binding, b.resource.type});
    if (b.binding != 8) uses.push_back(reads(b.resource, COMPUTE));
  }
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  const vulkan::Pipeline shares = take(vulkan::Pipeline::compute(device, pipeline, shaders.spirv("light_shares")));
  const auto count = static_cast<std::uint32_t>(lights.size());
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass("light shares", uses);
    recorder.bind(shares, bound);
    const std::array<std::uint32_t, 3> push{pixel % targets.width, pixel / targets.width, count};
    vkCmdPushConstants(recorder.commands(), shares.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), push.data());
    vkCmdDispatch(recorder.commands(), count / TERM_GROUP + 1, 1, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(ids);
  renderer.forget(terms);
  std::vector<glm::vec4> found(lights.size() + 1);
  std::memcpy(found.data(), terms.mapped().data(), found.size() * sizeof(glm::vec4));
  return {.lights = {found.begin(), found.end() - 1}, .surroundings = glm::vec3(found.back())};
}

}  // namespace lamp::app
