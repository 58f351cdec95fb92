// One dispatch over the picture for the walk, of which one thread works; one over the lights for the terms.
// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_lights.h"

#include <bit>

#include "gpu/transfer.h"
#include "render/answers.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LIGHT_GROUP = 64;  // threads of light_shares.comp and explain.comp

/// One thread a light: frame at binding 0, the lights' ids at 2, all lights at 3.
template <class Answer>
std::vector<Answer> for_lights(Renderer& renderer, const ShaderLibrary& shaders, std::span<const std::uint32_t> lights,
                               AnswersPass pass, std::size_t count) {
  const vulkan::Buffer ids =
      upload_buffer(renderer.context(), "lights of a pixel", std::as_bytes(lights), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  pass.bound.push_back({0, renderer.data().frame_constants()});
  pass.bound.push_back({2, vulkan::Resource::storage(ids.handle())});
  pass.bound.push_back({3, renderer.data().lights()});
  pass.answers_at = 8;
  pass.groups.x = static_cast<std::uint32_t>(count) / LIGHT_GROUP + 1;
  std::vector<Answer> found = answers_of<Answer>(renderer, shaders, std::move(pass), count);
  renderer.forget(ids);
  return found;
}

struct MarkedPixels {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// For each pixel a bit for each entity of the range that its walk brings, in whole words.
std::vector<std::uint32_t> marks_at(Renderer& renderer, Lighting& lighting, const MarkedPixels& pixels,
                                    const EntityRange& range) {
  const std::size_t words = std::size_t{pixels.end - pixels.first} * ((range.count() + 31) / 32);
  const vulkan::Buffer marks = readback_buffer(renderer.device(), "marks of pixels", words * sizeof(std::uint32_t));
  renderer.run({.shader = "visit_marks",
                .lighting = &lighting,
                .storage = {{2, vulkan::Resource::storage(marks.handle()),
                             VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                             /*zeroed=*/true}},
                .push = {pixels.first, pixels.end, range.first, range.end, range.end}});
  renderer.forget(marks);
  return first_values<std::uint32_t>(marks, words);
}

std::vector<std::uint32_t> entities_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel,
                                       const EntityRange& range) {
  const std::vector<std::uint32_t> found = marks_at(renderer, lighting, {pixel, pixel + 1}, range);
  std::vector<std::uint32_t> ids;
  for (std::uint32_t bit = 0; bit < range.count(); ++bit)
    if ((found[bit / 32] >> bit % 32 & 1U) != 0) ids.push_back(range.first + bit);
  return ids;
}

}  // namespace

std::vector<std::uint32_t> lights_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel) {
  return entities_at(renderer, lighting, pixel, renderer.entities().lights);
}

std::vector<std::uint32_t> pixels_with(Renderer& renderer, Lighting& lighting, std::uint32_t light) {
  const Targets& targets = renderer.targets();
  const std::uint32_t id = renderer.entities().lights.first + light;
  return marks_at(renderer, lighting, {0, targets.width * targets.height}, {id, id + 1});
}

std::vector<std::uint32_t> probes_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel) {
  const EntityRange probes = renderer.entities().probes;
  std::vector<std::uint32_t> found = entities_at(renderer, lighting, pixel, probes);
  for (std::uint32_t& id : found) id -= probes.first;
  return found;
}

std::vector<ProbeWeight> probe_weights(Renderer& renderer, const ShaderLibrary& shaders, const glm::vec3& position,
                                       std::span<const std::uint32_t> probes) {
  if (probes.empty()) return {};
  const std::uint32_t push[] = {std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
                                std::bit_cast<std::uint32_t>(position.z), static_cast<std::uint32_t>(probes.size())};
  return for_lights<ProbeWeight>(renderer, shaders, probes,
                                 {.shader = "probe_weights",
                                  .constants = {{CONSTANT_PROBES, renderer.probes().kind()}},
                                  .bound = renderer.probes().bound(),
                                  .push = std::as_bytes(std::span(push))},
                                 probes.size());
}

PixelTerms terms_at(Renderer& renderer, const ShaderLibrary& shaders, const GpuScene& scene, const LightingInfo& info,
                    std::uint32_t pixel, const PixelEntities& walked) {
  if (info.path == ShadingPath::forward) renderer.need_surfaces();
  const Targets& targets = renderer.targets();
  const std::uint32_t push[] = {pixel % targets.width, pixel / targets.width,
                                static_cast<std::uint32_t>(walked.lights.size()),
                                static_cast<std::uint32_t>(walked.probes.size())};
  AnswersPass pass{.shader = "light_shares",
                   .constants = {{CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)}, shadow_constant(info.shadows)},
                   .bound = gbuffer_bound(targets),
                   .push = std::as_bytes(std::span(push))};
  pass.constants.push_back({CONSTANT_PROBES, info.probes});
  pass.constants.push_back(mirror_limit_constant(info.mirror));
  for (const vulkan::Bound& b : renderer.probes().bound()) pass.bound.push_back(b);
  pass.bound.push_back({4, scene.surroundings()});
  for (const vulkan::Bound& b : renderer.shadow_bound()) pass.bound.push_back(b);
  std::vector<std::uint32_t> ids(walked.lights.begin(), walked.lights.end());
  ids.insert(ids.end(), walked.probes.begin(), walked.probes.end());
  const std::vector<glm::vec4> terms =
      for_lights<glm::vec4>(renderer, shaders, ids, std::move(pass), walked.lights.size() + 1);
  return {.lights = {terms.begin(), terms.end() - 1},
          .surroundings = glm::vec3(terms.back()),
          .left_by_mirror = terms.back().w};
}

std::vector<gpu::Explained> explain(Renderer& renderer, const ShaderLibrary& shaders, gpu::ExplainedCell cell,
                                    std::span<const std::uint32_t> lights) {
  cell.count = static_cast<std::uint32_t>(lights.size());
  return for_lights<gpu::Explained>(renderer, shaders, lights,
                                    {.shader = "explain", .push = std::as_bytes(std::span(&cell, 1))}, lights.size());
}

}  // namespace lamp::app
