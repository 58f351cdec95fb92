// Asks the passes and the look-up.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/lit_lights.h"

namespace lamp::app {
namespace {

constexpr Light POINT{.position = {1.0F, 2.0F, -3.0F}, .range = 8.0F};
constexpr Light SPOT{.type = LightType::spot,
                     .position = {-4.0F, 0.5F, 2.0F},
                     .range = 8.0F,
                     .direction = {0.2F, -1.0F, 0.5F},
                     .outer_angle = 0.7F};
constexpr Light WIDE_SPOT{.type = LightType::spot,
                          .position = {3.0F, 1.0F, 4.0F},
                          .range = 8.0F,
                          .direction = {0.0F, -1.0F, 0.1F},
                          .outer_angle = 1.41F};

void add_light(LitLights& lit, const Light& light, const ShadowAtlasInfo& info, std::uint32_t side, glm::uvec2 corner) {
  std::vector<UVec2> corners;
  for (std::uint32_t i = 0; i < shadow_squares(pack(light), info.points); ++i)
    corners.emplace_back(corner + glm::uvec2(i % 3, i / 3) * side);
  lit.lights.push_back(pack(light));
  lit.maps.push_back(shadow_map(pack(light), info, side, corners));
}

}  // namespace

LitLights some_lit_lights(ShadowFilter filter) {
  LitLights lit;
  const auto add = [&](const Light& light, PointShadows points, std::uint32_t side, glm::uvec2 corner) {
    add_light(lit, light, {.size = LIT_ATLAS, .points = points, .filter = filter}, side, corner);
  };
  add(POINT, PointShadows::faces, 64, {0, 0});
  add(POINT, PointShadows::faces, 16, {192, 0});
  add(POINT, PointShadows::octahedron, 128, {0, 128});
  add(POINT, PointShadows::octahedron, 16, {256, 0});
  add(SPOT, PointShadows::faces, 128, {128, 128});
  add(SPOT, PointShadows::faces, 16, {272, 0});
  add(POINT, PointShadows::faces, 64, {256, 128});
  lit.lights.back().position.x += 0.5F;
  return lit;
}

LitLights wide_lit_light(ShadowFilter filter) {
  LitLights lit;
  add_light(lit, WIDE_SPOT, {.size = LIT_ATLAS, .filter = filter}, 64, {320, 0});
  return lit;
}

LitLights large_lit_light(ShadowFilter filter) {
  LitLights lit;
  const ShadowAtlasInfo info{.size = LIT_ATLAS, .points = PointShadows::octahedron, .filter = filter};
  add_light(lit, POINT, info, 256, {0, 256});
  return lit;
}

std::vector<float> some_wall_depths(test::Random& random) {
  std::vector<float> depths(std::size_t{LIT_ATLAS} * LIT_ATLAS);
  for (std::uint32_t y = 0; y < LIT_ATLAS; ++y)
    for (std::uint32_t x = 0; x < LIT_ATLAS; ++x) {
      const bool hole = (x / 48 + y / 64) % 5 == 0 && random.in(0.0F, 1.0F) < 0.002F;
      const float wall = 1.0F + 0.5F * static_cast<float>((x / 32 + 3 * (y / 32)) % 7);
      depths[y * LIT_ATLAS + x] = hole ? 0.0F : 0.01F / (wall * random.in(0.7F, 1.0F));
    }
  return depths;
}

std::vector<shared::ShadowCase> some_lit_cases(const LitLights& lit, test::Random& random) {
  std::vector<shared::ShadowCase> cases(LIT_CASES);
  for (shared::ShadowCase& c : cases) {
    c.light = random.below(static_cast<std::uint32_t>(lit.maps.size()));
    const shared::Light& light = lit.lights[c.light];
    glm::vec3 direction = random.direction();
    if (light.type == shared::LIGHT_SPOT)  // within its cone
      while (glm::dot(direction, glm::vec3(light.direction)) < light.cos_outer) direction = random.direction();
    c.position = glm::vec3(lit.maps[c.light].position) + direction * random.in(0.2F, 8.0F);
    c.normal = random.direction();
    c.seed = random.below(~0U);
  }
  return cases;
}

std::vector<float> shadows_of(const std::vector<shared::ShadowCase>& cases, const LitLights& lit, const GpuImage& atlas,
                              ShadowFilter filter) {
  const vulkan::Buffer case_buffer = host_buffer_of("cases", cases);
  const vulkan::Buffer map_buffer = host_buffer_of("maps", lit.maps);
  const vulkan::Buffer shadow = host_buffer("shadow", cases.size() * sizeof(float));
  dispatch({.shader = "shadow_lookup",
            .constants = {static_cast<std::uint32_t>(filter)},
            .resources = {vulkan::Resource::storage(case_buffer.handle()), vulkan::Resource::storage(shadow.handle()),
                          vulkan::Resource::storage(map_buffer.handle()), atlas.sampled(), atlas.sampled()},
            .groups = {static_cast<std::uint32_t>(cases.size() / 64), 1, 1}});
  return contents<float>(shadow);
}

void make_reach(ShadowReach& reach, const LitLights& lit, const GpuImage& atlas) {
  const vulkan::Buffer map_buffer = host_buffer_of("maps", lit.maps);
  std::vector<shared::RadialJob> jobs;
  for (std::uint32_t i = 0; i < lit.lights.size(); ++i)
    jobs.push_back({.light = i, .shows_all = shadow_shows_all(lit.maps[i], lit.lights[i]) ? 1U : 0U});
  reach.add(jobs);
  vulkan::AccessTracker tracker;
  tracker.assume(atlas.sampled());
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    reach.record(recorder,
                 {.maps = vulkan::Resource::storage(map_buffer.handle()), .host_maps = lit.maps, .atlas = atlas});
  });
}

ShadowReach reach_of(ShadowReach::Kind kind, const LitLights& lit, const GpuImage& atlas, ShadowFilter filter) {
  ShadowReach reach(test_context().device(), shader_library(), kind, filter,
                    static_cast<std::uint32_t>(lit.lights.size()));
  make_reach(reach, lit, atlas);
  return reach;
}

}  // namespace lamp::app
