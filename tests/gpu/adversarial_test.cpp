// Every method on the scenes that are made to be hard on culling: nothing missed, brute force's picture.
// The lights are the scenes' own placement, all of it; the hard cases of other tests would blur what each is about.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr glm::uvec2 SIZE(112, 63);
constexpr std::uint32_t COUNTS[] = {33, 2048};
constexpr std::uint32_t LARGEST_COUNT = 2048;

/// A scene through one of its cameras, with its lights.
struct HardCase {
  HardCase(const BuiltinScene& row, std::size_t camera, std::uint32_t count)
      : name(fmt::format("{}, camera {}, {} lights", row.name, camera, count)),
        scene(builtin_test_scene(row.name)),
        renderer(test_context(), shader_library(), scene.gpu, SIZE.x, SIZE.y, LARGEST_COUNT),
        lit(make_case(renderer, view_of(scene.scene.cameras.at(camera), SIZE.x, SIZE.y, "camera"),
                      pack(place_lights(scene.air, {.count = count, .seed = count})))) {}

  std::string name;
  const TestScene& scene;
  Renderer renderer;
  LitCase lit;
};

/// Many lights for the first camera, which a scene is made for; few for its last one.
std::vector<std::unique_ptr<HardCase>>& hard_cases() {
  static std::vector<std::unique_ptr<HardCase>> cases;
  if (!cases.empty()) return cases;
  at_context_end([] { cases.clear(); });
  for (const BuiltinScene& row : adversarial_scenes()) {
    cases.push_back(std::make_unique<HardCase>(row, 0, COUNTS[1]));
    const std::size_t last = builtin_test_scene(row.name).scene.cameras.size() - 1;
    cases.push_back(std::make_unique<HardCase>(row, last, COUNTS[0]));
  }
  return cases;
}

class AdversarialScenes : public GpuTest, public ::testing::WithParamInterface<const Method*> {};

TEST_P(AdversarialScenes, MissNothingAndEqualBruteForce) {
  for (const auto& hard : hard_cases()) {
    SCOPED_TRACE(hard->name);
    check_method(hard->renderer, hard->lit, {.method = GetParam(), .light_capacity = LARGEST_COUNT});
    if (HasFailure()) return;  // one report is enough
  }
}

/// Races inside a plan must not show.
TEST_P(AdversarialScenes, ListsAreTheSameEveryRun) {
  std::size_t number = static_cast<std::size_t>(GetParam() - methods().data());
  for (const auto& hard : hard_cases()) {
    if (!has_turn(number++, 3)) continue;
    SCOPED_TRACE(hard->name);
    Lighting lighting = make_lighting(hard->renderer, {.method = GetParam(), .light_capacity = LARGEST_COUNT});
    if (!lighting.runner().plan().ordered) return;
    const std::vector<Visit> first = hard->renderer.visit_all(lighting);
    for (int run = 0; run < 3; ++run)
      ASSERT_TRUE(same_lists(hard->renderer.visit_all(lighting), first)) << "run " << run;
  }
}

std::vector<const Method*> all_methods() {
  std::vector<const Method*> all;
  for (const Method& method : methods()) all.push_back(&method);
  return all;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, AdversarialScenes, ::testing::ValuesIn(all_methods()),
                         [](const auto& test) { return test_name(test.param->name); });

}  // namespace
}  // namespace lamp::app
