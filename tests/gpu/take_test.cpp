// Work groups that take the lights of their cell many at once meet those of the plain walk, in its order.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gpu/method_check.h"
#include "gpu/over_depth.h"
#include "gpu/test_surfaces.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t WIDTH = 173;  // neither tiles nor groups end with it
constexpr std::uint32_t HEIGHT = 101;
constexpr std::uint32_t COUNT = 300;

/// Lists longer than a group, some lights in all of them, bits that are sparse in places.
std::vector<shared::Light> uneven_lights() {
  std::vector<Light> lights(COUNT);
  for (std::uint32_t i = 0; i < COUNT; ++i) {
    const float turn = 2.4F * static_cast<float>(i);
    const float off = 3.0F * std::sqrt(static_cast<float>(i) / COUNT);
    lights[i].position = {off * std::cos(turn), off * std::sin(turn), 0.5F};
    lights[i].range = i % 3 == 0 ? 40.0F : 0.8F;
  }
  return pack(lights);
}

struct Case {
  std::string_view method;
  std::vector<std::string> settings;
  std::string_view lookup;
};

/// Each look-up whose groups may take lights together, and what a cell walks whose lights did not fit.
std::vector<Case> cases() {
  return {{"all", {}, "all"},
          {"tiled", {}, "tile_lists"},
          {"tiled", {"capacity=64"}, "tile_lists"},
          {"tiled-bits", {}, "tile_bits"},
          {"tiled-bits", {"tile=8"}, "tile_bits"},
          {"tiled", {"order=type"}, "tile_typed"},
          {"lamplight", {}, "cell_lists"},
          {"lamplight", {"tile=8", "mean_capacity=1"}, "cell_lists"},
          {"lamplight", {"container=bits"}, "cell_bits"},
          {"lamplight", {"container=bits", "cells=list", "mean_cells=1"}, "cell_bits"}};
}

class Take : public GpuTest {};

TEST_F(Take, MeetsTheLightsOfThePlainWalk) {
  const Scene scene = wall_scene({});
  const View view = view_of(scene.cameras.front(), WIDTH, HEIGHT, "camera");
  OverDepth over(view, std::vector<float>(std::size_t{WIDTH} * HEIGHT, 0.05F), uneven_lights());
  for (const Case& c : cases()) {
    SCOPED_TRACE(fmt::format("{} {}", c.method, fmt::join(c.settings, " ")));
    const Method& method = *take(find_method(c.method));
    Plan plan = take(make_plan(method, {.width = WIDTH,
                                        .height = HEIGHT,
                                        .light_capacity = COUNT,
                                        .options = take(resolve_options(method, c.settings)),
                                        .traits = test_context().device().traits}));
    ASSERT_EQ(plan.lookup.name, c.lookup);
    vulkan::PlanRunner runner =
        take(vulkan::PlanRunner::create(test_context().device(), std::move(plan), shader_library().source()));
    const std::vector<std::uint32_t> plainly = over.per_pixel("count_everywhere", runner, Passes::separate);
    EXPECT_GT(std::ranges::max(plainly), 2 * 64U) << "lists that one group cannot take at once";
    EXPECT_EQ(over.per_pixel("take_everywhere", runner, Passes::separate), plainly);
  }
}

}  // namespace
}  // namespace lamp::app
