// Asks rays and filter in bands of rows, so that no dispatch takes long.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_leaks.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "gpu/transfer.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP_PX = 8;  // BVH_THREADS of shadow_leaks.comp
constexpr std::uint32_t BVH_FIRST_BINDING = 32;
constexpr std::uint32_t CONSTANT_STACK = 30;

/// Of a dispatch, and of its buffer: with two rays for each of a hundred lights a second on a slow GPU, before which
/// systems reset one.
constexpr std::uint32_t BAND_PX = 1 << 18;

std::vector<std::uint32_t> words_of(const gpu::ShadowLeakAsked& asked) {
  std::vector<std::uint32_t> words(sizeof(asked) / sizeof(std::uint32_t));
  std::memcpy(words.data(), &asked, sizeof(asked));
  return words;
}

/// What the shader reads besides frame, depth and look-up.
std::vector<vulkan::Bound> bound_of(const Renderer& renderer, const MirrorScene& rays) {
  std::vector<vulkan::Bound> bound = rays.bound(BVH_FIRST_BINDING);
  bound.push_back({3, renderer.data().lights()});
  bound.push_back({5, renderer.targets().base_color.sampled()});
  bound.push_back({6, renderer.targets().surface.sampled()});
  for (const vulkan::Bound& b : renderer.shadow_bound()) bound.push_back(b);
  return bound;
}

}  // namespace

std::string why_no_leaks(const Renderer& renderer, const Lighting& lighting, const Scene& scene) {
  if (renderer.shadows() == nullptr) return "no light casts a shadow";
  if (scene.captured || scene.instances.empty()) return "the scene has no triangles that rays could meet";
  if (renderer.still() != nullptr) return "no list of the picture has the lights of --still-lists";
  if (is_cut(renderer, lighting))
    return "the method's lists leave out lights that shadow maps keep dark, rightly or not: choose one that does not";
  return "";
}

std::vector<gpu::ShadowLeak> shadow_leaks(Renderer& renderer, Lighting& lighting, const MirrorScene& rays) {
  assert(renderer.shadows() != nullptr);
  renderer.need_surfaces();
  const std::uint32_t width = renderer.targets().width;
  const std::uint32_t height = renderer.targets().height;
  const std::uint32_t band_rows = std::max(BAND_PX / width / GROUP_PX, 1U) * GROUP_PX;
  const vulkan::Buffer found =
      readback_buffer(renderer.device(), "leaks of shadows",
                      std::uint64_t{std::min(band_rows, height)} * width * sizeof(gpu::ShadowLeak));
  const EntityRange lights = renderer.entities().lights;
  gpu::ShadowLeakAsked asked{.first_row = 0,
                             .first_light = lights.first,
                             .end_light = lights.end,
                             .root = rays.bvh().root,
                             .two = 2,
                             .ends_m = {static_cast<float>(RAY_END.m), static_cast<float>(RAY_SECOND_END.m)},
                             .end_shares = {static_cast<float>(RAY_END.most), static_cast<float>(RAY_SECOND_END.most)},
                             .off = {static_cast<float>(OFF_OF_DISTANCE), static_cast<float>(OFF_OF_COORDINATES)}};
  PixelPass pass{.shader = "shadow_leaks",
                 .lighting = &lighting,
                 .storage = {{2, vulkan::Resource::storage(found.handle()), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}},
                 .bound = bound_of(renderer, rays),
                 .constants = {{CONSTANT_BRDF, static_cast<std::uint32_t>(lighting.info().brdf)},
                               {CONSTANT_STACK, std::max(rays.bvh().stack, 1U)},
                               shadow_constant(renderer.shadows()->settings().filter)},
                 .group_px = GROUP_PX,
                 .push = words_of(asked)};
  const vulkan::Pipeline pipeline = renderer.pixel_pipeline(pass);
  std::vector<gpu::ShadowLeak> leaks;
  leaks.reserve(std::size_t{width} * height);
  for (; asked.first_row < height; asked.first_row += band_rows) {
    pass.rows = {.first = asked.first_row, .count = std::min(band_rows, height - asked.first_row)};
    pass.push = words_of(asked);
    renderer.run(pass, pipeline);
    pass.prepares = false;
    const auto band = first_values<gpu::ShadowLeak>(found, std::size_t{pass.rows.count} * width);
    leaks.insert(leaks.end(), band.begin(), band.end());
  }
  renderer.forget(found);
  return leaks;
}

LeakSums sum_of(std::span<const gpu::ShadowLeak> pixels) {
  LeakSums sums;
  for (const gpu::ShadowLeak& pixel : pixels) {
    sums.ended += pixel.found == gpu::LEAK_ENDED ? 1 : 0;
    if (pixel.found != gpu::LEAK_FOUND) continue;
    sums.unclear += pixel.unclear;
    sums.light.arriving += double{pixel.arriving};
    sums.light.stopped += double{pixel.stopped};
    sums.light.leaked += double{pixel.leaked};
    sums.light.lost += double{pixel.lost};
  }
  return sums;
}

}  // namespace lamp::app
