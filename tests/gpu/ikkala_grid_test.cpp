// What is `ikkala-grid`'s own, beside world_points_test.cpp: its options, its border, the order of its walks.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/check.h"
#include "gpu/point_asks.h"

namespace lamp::app {
namespace {

constexpr std::size_t POINTS = 2000;
constexpr std::uint32_t LIGHTS = 3000;  // three blocks, the last of them not full

using test::lights_around;
using test::Points;
using test::points_in;

Answered ask(const Asked& asked) { return answer(*take(find_method("ikkala-grid")), asked); }

Asked around_the_origin(std::vector<std::string> settings = {}) {
  return {.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
          .points = points_in(1, POINTS, glm::vec3(-15.0F), glm::vec3(15.0F)),
          .settings = std::move(settings)};
}

class IkkalaGrid : public GpuTest {};

TEST_F(IkkalaGrid, WalksTheLightsWhoseBoxHoldsAPoint) {
  Asked asked = around_the_origin();
  for (shared::Light& light : asked.lights) light.type = shared::LIGHT_POINT;
  const Answered answered = ask(asked);
  EXPECT_GT(answered.findings.useful, 5 * POINTS);
  EXPECT_LT(answered.findings.waste(), 2.0);  // a cube over its sphere is 1.91, and cells are small
  EXPECT_EQ(answered.counters.overflowed_cells, 0);
}

TEST_F(IkkalaGrid, CutsSpotsByTheirConesBox) {
  Asked narrow = around_the_origin();
  std::vector<Light> lights;
  for (const shared::Light& light : narrow.lights)
    lights.push_back({.type = LightType::spot,
                      .position = {light.position.x, light.position.y, light.position.z},
                      .range = light.range,
                      .direction = {0.0F, -1.0F, 0.0F},
                      .outer_angle = 0.05F});
  narrow.lights = pack(lights);
  const Answered answered = ask(narrow);
  EXPECT_GT(answered.findings.useful, 0U);
  EXPECT_LT(answered.findings.waste(), 8.0);  // its sphere alone: over a hundred
}

TEST_F(IkkalaGrid, TakesGridsOfEverySize) {
  for (const char* cells : {"cells=8", "cells=63", "cells=64", "cells=1023"}) {
    SCOPED_TRACE(cells);
    ask(around_the_origin({cells}));
  }
}

TEST_F(IkkalaGrid, NamesWhatReachesBeyondTheGrid) {
  for (const glm::vec3& eye : {glm::vec3(0.0F), glm::vec3(9.0F, 0.0F, 0.0F), glm::vec3(500.0F, -500.0F, 0.0F)}) {
    Asked asked = around_the_origin({"extent_m=2"});
    asked.view = view_from(eye);
    EXPECT_GT(ask(asked).findings.useful, POINTS);
  }
}

TEST_F(IkkalaGrid, WalksAscendWithoutTheCurve) {
  const Answered by_index = ask(around_the_origin({"order=index"}));
  const Answered by_curve = ask(around_the_origin());
  ASSERT_EQ(by_index.lights.offsets, by_curve.lights.offsets);
  for (std::size_t point = 0; point < POINTS; ++point) {
    const auto curve = by_curve.lights.of(point);
    std::vector<std::uint32_t> sorted(curve.begin(), curve.end());
    std::ranges::sort(sorted);
    EXPECT_TRUE(std::ranges::equal(sorted, by_index.lights.of(point))) << point;
  }
}

// A light that reaches all of the grid is in every slice, and takes no small light's words with it.
TEST_F(IkkalaGrid, KnowsLightsOfVeryDifferentRanges) {
  Asked asked = around_the_origin();
  const std::vector<shared::Light> large = lights_around({}, 10.0F, 30.0F, 2000.0F, 40);
  for (std::size_t i = 0; i < large.size(); ++i) asked.lights.insert(asked.lights.begin() + 70 * i, large[i]);
  asked.lights.push_back(pack(Light{}));
  ask(asked);
}

TEST_F(IkkalaGrid, SaysWhereCellsAreFewer) {
  const Method& method = *take(find_method("ikkala-grid"));
  DeviceTraits traits;
  const auto notes_of = [&](std::uint32_t lights, const std::vector<std::string>& settings) {
    return take(make_plan(method, {.width = 64,
                                   .height = 64,
                                   .light_capacity = lights,
                                   .options = take(resolve_options(method, settings)),
                                   .traits = traits}))
        .notes;
  };
  EXPECT_TRUE(notes_of(65536, {}).empty());
  ASSERT_EQ(notes_of(1U << 20, {}).size(), 1U);
  EXPECT_EQ(notes_of(1U << 20, {})[0],
            "169 cells along each axis instead of 511: their bits for 1048576 lights would take over 64 MiB");
  traits.max_storage_buffer_bytes = 128U << 20;
  ASSERT_EQ(notes_of(1U << 20, {"cells=500"}).size(), 1U);
}

}  // namespace
}  // namespace lamp::app
