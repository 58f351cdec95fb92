// The look-up of `world-tree` on the GPU, in both languages: the lists that the host reads from the same words, and no
// light missed that reaches a point and sees it, in any scene.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/world_tree.h"

#include <algorithm>
#include <limits>

#include "gpu/made_up_frame.h"
#include "gpu/method_check.h"
#include "gpu/over_depth.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/point_check.h"
#include "render/scene_occluders.h"
#include "scene/flight.h"
#include "scene/random_points.h"
#include "scene/still_triangles.h"
#include "world_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t SIDE = 64;   // pixels: the picture does not matter
constexpr std::size_t POINTS = 500;  // of each kind
constexpr std::uint32_t LIGHTS = 150;
constexpr std::uint32_t WORDS = 11;  // of a pixel, in walks.comp

using test::Points;
using test::points_in;

Plan plan_of(std::size_t lights, glm::uvec2 size = {SIDE, SIDE}) {
  const Method& method = *take(find_method("world-tree"));
  return take(make_plan(method, {.width = size.x,
                                 .height = size.y,
                                 .light_capacity = static_cast<std::uint32_t>(lights),
                                 .options = take(resolve_options(method, {})),
                                 .traits = test_context().device().traits}));
}

/// What the GPU finds is what the host does, and misses nothing of the truth.
void expect_as_on_the_host(const WorldTree& tree, const View& view, const Points& points, const Occluders* occluders) {
  PointWalks walks(test_context(), shader_library(), plan_of(tree.lights().size()), view, tree.lights(), tree.words());
  const PointLights found = walks.walk(points);
  std::size_t named = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<std::uint32_t> expected = tree.lights_at(Vec3(points[i]));
    ASSERT_TRUE(std::ranges::equal(found.of(i), expected)) << "point " << i;
    named += expected.size();
  }
  EXPECT_GT(named, 0U);
  PointTruth truth = truth_at(points, tree.lights());
  if (occluders != nullptr) truth = seen_at(truth, points, tree.lights(), *occluders);
  EXPECT_EQ(check_points(found, truth, tree.lights().size()).reason(), "");
}

class WorldTreeInScene : public GpuTest, public ::testing::WithParamInterface<BuiltinScene> {};

TEST_P(WorldTreeInScene, MissesNoLightThatSeesAPoint) {
  const TestScene& scene = builtin_test_scene(GetParam().name);
  const View view = view_of(find_camera(scene.scene, ""), SIDE, SIDE, "infinite");
  const std::vector<shared::Light> lights = test_lights(scene.air, view, {.count = LIGHTS});
  const PointSource source(scene.scene, scene.air, glm::vec3(glm::dmat4(view.world_from_view())[3]));
  Points points;
  for (const PointKind kind : POINT_KINDS)
    for (const glm::vec3& point : source.draw(kind, POINTS, 1)) points.push_back(point);
  const WorldTree tree = take(WorldTree::build(
      {.lights = lights, .occluders = std::make_shared<StillOccluders>(still_triangles(scene.scene)), .detail = 6}));
  const Occluders occluders = scene_occluders(scene.scene);
  expect_as_on_the_host(tree, view, points, &occluders);
}

INSTANTIATE_TEST_SUITE_P(Of, WorldTreeInScene, ::testing::ValuesIn(builtin_scenes()),
                         [](const auto& test) { return test_name(test.param.name); });

class WorldTreeLookUp : public GpuTest {};

TEST_F(WorldTreeLookUp, IsRightFarAwayNowhereAndOfEveryLight) {
  const View view = made_up_view({SIDE, SIDE}, 0.0);
  for (const float far_away : {0.0F, 1e5F}) {
    std::vector<Light> lights;
    for (const glm::vec3& position : points_in(9, 1000, glm::vec3(far_away - 20.0F), glm::vec3(far_away + 20.0F)))
      if (lights.size() < 200) lights.push_back({.position = position, .range = 6.0F});
    lights.push_back({.position = {}, .range = std::numeric_limits<float>::infinity()});
    Points points = points_in(9, 1000, glm::vec3(far_away - 30.0F), glm::vec3(far_away + 30.0F));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    points.insert(points.end(), {{nan, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}, {-1e30F, 0, 0}});
    const std::vector<shared::Light> packed = pack(lights);
    expect_as_on_the_host(take(WorldTree::build({.lights = packed})), view, points, nullptr);
    expect_as_on_the_host(take(WorldTree::build({.lights = packed, .budget = 0})), view, points, nullptr);
  }
}

// A pixel's helper may read nothing else: then a node's children are that node again.
TEST_F(WorldTreeLookUp, EndsWhereAllWordsAreZeros) {
  const std::vector<shared::Light> lights = pack(std::vector<Light>{{.position = {9.0F, 0.0F, 0.0F}, .range = 1.0F}});
  const std::vector<std::uint32_t> zeros(64, 0);
  const Points points{{0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 3.0F}};
  PointWalks walks(test_context(), shader_library(), plan_of(lights.size()), made_up_view({SIDE, SIDE}, 0.0), lights,
                   zeros);
  const PointLights found = walks.walk(points);
  EXPECT_EQ(check_points(found, truth_at(points, lights), lights.size()).reason(), "");
  EXPECT_TRUE(found.of(0).empty() && found.of(1).empty());
}

TEST_F(WorldTreeLookUp, WalksInHlslAsInGlsl) {
  const glm::uvec2 size(85, 53);
  const View view = made_up_view(size, 0.2);
  const std::vector<shared::Light> lights = scattered_lights(view, 500);
  OverDepth frame(view, made_up_depths(size), lights);
  const WorldTree tree = take(WorldTree::build({.lights = lights, .detail = 8}));
  frame.set_still(tree.words());
  auto runner = take(
      vulkan::PlanRunner::create(test_context().device(), plan_of(lights.size(), size), shader_library().source()));
  const auto words = frame.per_pixel({"walks", "walks.hlsl"}, runner, vulkan::PlanRunner::Passes::separate, WORDS);
  EXPECT_EQ(words[0], words[1]);
  EXPECT_TRUE(std::ranges::any_of(words[0], [](std::uint32_t word) { return word != 0; }));
  OverDepth without(view, made_up_depths(size), lights);
  const auto every = without.per_pixel({"walks"}, runner, vulkan::PlanRunner::Passes::separate, WORDS);
  EXPECT_NE(words[0], every[0]) << "without a tree, every light";
}

}  // namespace
}  // namespace lamp::app
