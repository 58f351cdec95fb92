// Lists that are too short: the picture stays exact, nothing is missed, and the cells are counted.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

struct TooShort {
  const char* method;
  const char* setting;
};

class Overflow : public GpuTest, public ::testing::WithParamInterface<TooShort> {};

TEST_P(Overflow, IsCountedAndLosesNothing) {
  const TestScene& scene = builtin_test_scene("atrium");
  const View view = view_of(find_camera(scene.scene, ""), 97, 55, "infinite");
  Renderer renderer(test_context(), shader_library(), scene.gpu, 97, 55, 512);
  const LitCase lit = make_case(renderer, view, test_lights(scene.air, view, {.count = 300}));
  const Method& method = *take(find_method(GetParam().method));
  const auto capacity = static_cast<std::uint32_t>(lit.lights.size());
  const Candidate roomy{.method = &method, .light_capacity = capacity};
  const Candidate tight{.method = &method, .settings = {GetParam().setting}, .light_capacity = capacity};

  const Findings with_room = check_method(renderer, lit, roomy);
  const Findings without = check_method(renderer, lit, tight);
  EXPECT_GT(without.evaluations, with_room.evaluations);
  EXPECT_EQ(without.list_max, lit.lights.size());
  Lighting lighting = make_lighting(renderer, tight);
  EXPECT_GT(renderer.render(lighting).counters.overflowed_cells, 0U);
  Lighting enough = make_lighting(renderer, roomy);
  EXPECT_EQ(renderer.render(enough).counters.overflowed_cells, 0U);
}

INSTANTIATE_TEST_SUITE_P(EveryList, Overflow,
                         ::testing::Values(TooShort{"tiled", "capacity=1"}, TooShort{"stewart-half-z", "capacity=2"},
                                           TooShort{"primal-base", "capacity=3"}, TooShort{"primal", "mean_capacity=1"},
                                           TooShort{"primal", "capacity=1"}, TooShort{"tight", "capacity=1"},
                                           TooShort{"clustered", "mean_capacity=1"}),
                         [](const auto& given) {
                           return test_name(std::string(given.param.method) + " " + given.param.setting);
                         });

}  // namespace
}  // namespace lamp::app
