// Radial bounds against the look-up: what a look-up finds lit at all is within the bound, for any depths, normals and
// seeds; and bounds cut what lies in shadow.
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "gpu/dispatch.h"
#include "gpu/random_cases.h"
#include "gpu/shaders/shadow_case.h"
#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"
#include "render/shadow_radial.h"

namespace lamp::app {
namespace {

using shared::ShadowCase;
using shared::ShadowMap;

constexpr std::uint32_t ATLAS = 512;
constexpr std::uint32_t CASES = 64 * 2048;

constexpr Light POINT{.position = {1.0F, 2.0F, -3.0F}, .range = 8.0F};
constexpr Light SPOT{.type = LightType::spot,
                     .position = {-4.0F, 0.5F, 2.0F},
                     .range = 8.0F,
                     .direction = {0.2F, -1.0F, 0.5F},
                     .outer_angle = 0.7F};

struct Lit {
  std::vector<shared::Light> lights;
  std::vector<ShadowMap> maps;
};

/// Maps of every kind and of several sizes, the last one of a light that has moved since.
Lit some_lights(ShadowFilter filter) {
  Lit lit;
  const auto add = [&](const Light& light, PointShadows points, std::uint32_t side, glm::uvec2 corner) {
    const ShadowAtlasInfo info{.size = ATLAS, .points = points, .filter = filter};
    std::vector<UVec2> corners;
    for (std::uint32_t i = 0; i < shadow_squares(pack(light), points); ++i)
      corners.emplace_back(corner + glm::uvec2(i % 3, i / 3) * side);
    lit.lights.push_back(pack(light));
    lit.maps.push_back(shadow_map(pack(light), info, side, corners));
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

/// Walls at some metres that are whole over several cells, with holes and what stands before them.
std::vector<float> some_depths(Random& random) {
  std::vector<float> depths(std::size_t{ATLAS} * ATLAS);
  for (std::uint32_t y = 0; y < ATLAS; ++y)
    for (std::uint32_t x = 0; x < ATLAS; ++x) {
      const bool hole = (x / 48 + y / 64) % 5 == 0 && random.in(0.0F, 1.0F) < 0.002F;
      const float wall = 1.0F + 0.5F * static_cast<float>((x / 32 + 3 * (y / 32)) % 7);
      depths[y * ATLAS + x] = hole ? 0.0F : 0.01F / (wall * random.in(0.7F, 1.0F));
    }
  return depths;
}

/// Around where the walls are.
std::vector<ShadowCase> some_cases(const Lit& lit, Random& random) {
  std::vector<ShadowCase> cases(CASES);
  for (ShadowCase& c : cases) {
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

class ShadowRadialBounds : public GpuTest, public ::testing::WithParamInterface<ShadowFilter> {};

TEST_P(ShadowRadialBounds, HoldEverythingThatIsLit) {
  Random random(5);
  const Lit lit = some_lights(GetParam());
  const auto count = static_cast<std::uint32_t>(lit.lights.size());
  const std::vector<ShadowCase> cases = some_cases(lit, random);
  const GpuImage atlas = depth_image(ATLAS, ATLAS, some_depths(random));
  const vulkan::Buffer case_buffer = host_buffer_of("cases", cases);
  const vulkan::Buffer map_buffer = host_buffer_of("maps", lit.maps);
  ShadowRadial radial(test_context(), shader_library(), GetParam(), count);
  std::vector<ShadowRedraw> redraws;
  for (std::uint32_t i = 0; i < count; ++i) redraws.push_back({.light = i});
  radial.set(lit.maps, lit.lights, redraws);
  const vulkan::Resource maps = vulkan::Resource::storage(map_buffer.handle());
  vulkan::AccessTracker tracker;
  tracker.assume(atlas.sampled());
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    radial.record(recorder, maps, atlas);
  });
  const vulkan::Buffer shadow = host_buffer("shadow", CASES * sizeof(float));
  dispatch({.shader = "shadow_lookup",
            .constants = {static_cast<std::uint32_t>(GetParam())},
            .resources = {vulkan::Resource::storage(case_buffer.handle()), vulkan::Resource::storage(shadow.handle()),
                          maps, atlas.sampled(), atlas.sampled()},
            .groups = {CASES / 64, 1, 1}});
  const vulkan::Buffer reached = host_buffer("reached", CASES * sizeof(std::uint32_t));
  dispatch({.shader = "radial_reach",
            .resources = {vulkan::Resource::storage(case_buffer.handle()), vulkan::Resource::storage(reached.handle()),
                          vulkan::Resource::storage(radial.bounds().handle())},
            .groups = {CASES / 64, 1, 1}});

  const std::vector<float> shadows = contents<float>(shadow);
  const std::vector<std::uint32_t> answers = contents<std::uint32_t>(reached);
  std::vector<std::array<std::uint32_t, 3>> found(count);  // in shadow, of these cut, points cut that are lit
  for (std::uint32_t i = 0; i < CASES; ++i) {
    std::array<std::uint32_t, 3>& sums = found[cases[i].light];
    const bool point_cut = (answers[i] & 1U) == 0;
    sums[0] += shadows[i] == 0.0F ? 1 : 0;
    sums[1] += shadows[i] == 0.0F && point_cut ? 1 : 0;
    sums[2] += shadows[i] > 0.0F && point_cut ? 1 : 0;
    ASSERT_TRUE((answers[i] & 2U) != 0 || point_cut) << "a box reaches no less far than a point in it";
  }
  for (std::uint32_t light = 0; light < count; ++light) {
    EXPECT_EQ(found[light][2], 0U) << "light " << light << " loses what is lit";
    const bool moved = light + 1 == count;
    const bool small = lit.maps[light].side < 64;
    if (moved) {
      EXPECT_EQ(found[light][1], 0U) << "it has moved since";
    } else if (!small) {
      EXPECT_GT(found[light][1], found[light][0] / 16) << "light " << light << " is hardly cut";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowRadialBounds, ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf),
                         [](const auto& test) { return test.param == ShadowFilter::hard ? "hard" : "pcf"; });

}  // namespace
}  // namespace lamp::app
