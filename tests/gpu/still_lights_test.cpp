// Lights that stand still, in lists of their triangles or in a tree: the same picture as with all lights in the
// picture's lists, and nothing missed at pixels and on surfaces.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/still_check.h"
#include "scene/flight.h"
#include "scene/number_triangles.h"
#include "scene/place_decals.h"
#include "scene/still_surfaces.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 160;
constexpr std::uint32_t HEIGHT = 90;
constexpr std::uint32_t COUNT = 200;
constexpr std::uint32_t STILL = 150;

Scene numbered(std::string_view name) {
  Scene scene = builtin_test_scene(name).scene;
  number_triangles(scene);
  return scene;
}

class StillLights : public GpuTest, public ::testing::WithParamInterface<std::string_view> {
 protected:
  StillLights()
      : scene_(numbered(GetParam())),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        lights_(test_lights(scene_.air, view_, {.count = COUNT, .mix = Mix::both})) {}

  void make(std::span<const gpu::DecalData> decals) {
    triangles_ = still_surfaces(scene_.scene, !decals.empty());
    const auto still = std::span(lights_).last(STILL);
    lists_ = take(make_triangle_lists({.triangles = triangles_, .lights = still, .slack_m = 0.01F}));
    on_gpu_.emplace(test_context(), gpu::STILL_TRIANGLES, STILL, lists_.words);
  }

  void make_tree(std::uint64_t budget = WorldTreeInfo().budget) {
    triangles_ = still_surfaces(scene_.scene, false);
    tree_.emplace(
        take(WorldTree::build({.lights = std::span(lights_).last(STILL), .budget = budget, .eyes_m = 100.0F})));
    on_gpu_.emplace(test_context(), gpu::STILL_TREE, STILL, tree_->words());
  }

  HdrImage picture(Renderer& renderer, const Method& method, std::span<const gpu::DecalData> decals,
                   ShadingPath path = ShadingPath::forward) {
    renderer.set_frame(view_, lights_, decals);
    const StillLists* still = renderer.still();
    const std::uint32_t listed = COUNT - (still == nullptr ? 0 : still->lights());
    Lighting lighting(renderer.device(), shader_library(),
                      {.method = &method,
                       .options = take(resolve_options(method, {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = listed + static_cast<std::uint32_t>(decals.size()),
                       .path = path,
                       .transparency = !scene_.gpu.blended().empty(),
                       .decals = !decals.empty(),
                       .still = still == nullptr ? gpu::STILL_OFF : still->kind()});
    return renderer.relight(lighting).image;
  }

  TestScene scene_;
  View view_;
  std::vector<shared::Light> lights_;
  std::vector<StillTriangle> triangles_;
  TriangleLists lists_;
  std::optional<WorldTree> tree_;
  std::optional<StillLists> on_gpu_;
};

constexpr ShadingPath WALKING[] = {ShadingPath::forward, ShadingPath::deferred, ShadingPath::tiled_deferred};

/// Glass, masked surfaces, instances; look-ups of the picture's lights with and without a fused form.
TEST_P(StillLights, PictureEqualsThatOfOneList) {
  make({});
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
  for (const ShadingPath path : WALKING) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    renderer.light_still(nullptr);
    const HdrImage reference = picture(renderer, brute_force(), {}, path);
    EXPECT_GT(largest_value(reference), 0.01F);
    renderer.light_still(&*on_gpu_);
    for (const char* method : {"all", "lamplight", "clustered", "tiled-bits"}) {
      SCOPED_TRACE(method);
      EXPECT_EQ(max_abs_difference(picture(renderer, *take(find_method(method)), {}, path), reference), 0.0F);
    }
  }
}

/// Numbers are drawn while lists of triangles are there, and no image of them is made for anything else.
TEST_P(StillLights, OnlyListsOfTrianglesNumberPixels) {
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
  make_tree();
  renderer.light_still(&*on_gpu_);
  EXPECT_FALSE(renderer.targets().numbered);
  EXPECT_EQ(renderer.targets().triangles.handle(), VK_NULL_HANDLE);
  make({});
  renderer.light_still(&*on_gpu_);
  EXPECT_TRUE(renderer.targets().numbered);
  renderer.set_frame(view_, lights_);
  const std::vector<std::uint32_t> numbers = renderer.read_triangles();
  EXPECT_LT(*std::ranges::max_element(numbers), triangles_.size());
  EXPECT_GT(std::set(numbers.begin(), numbers.end()).size(), 100U);
  renderer.keep_surfaces();  // which have no numbers: frames draw them anew
  EXPECT_EQ(renderer.read_triangles(), numbers);
  renderer.light_still(nullptr);
  EXPECT_FALSE(renderer.targets().numbered);
}

TEST_P(StillLights, NothingIsMissed) {
  make({});
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
  renderer.light_still(&*on_gpu_);
  renderer.set_frame(view_, lights_);
  const StillCheck check{.context = test_context(),
                         .shaders = shader_library(),
                         .triangles = triangles_,
                         .lights = std::span(lights_).last(STILL),
                         .list = [&](const gpu::StillPoint& p) { return lights_at(lists_, p.triangle, p.position); },
                         .on_gpu = *on_gpu_};
  const std::vector<gpu::StillPoint> pixels = points_of_pixels(renderer);
  EXPECT_GT(pixels.size(), 1000U);
  for (const auto& points : {pixels, random_points_on(triangles_, 2000, 1)}) {
    const StillFindings found = check_still_points(check, points);
    EXPECT_EQ(found.verdict(), Verdict::ok)
        << found.missed << " missed: " << found.first_miss << "; " << found.differing << " differ";
    EXPECT_GT(found.lighting, 0U);
  }
}

TEST_P(StillLights, HlslWalksAsGlslDoes) {
  make({});
  const std::vector<gpu::StillPoint> points = random_points_on(triangles_, 2000, 3);
  const auto hlsl = std::ranges::find(test_shaders(), "still_walk.hlsl", &ShaderCode::name);
  ASSERT_NE(hlsl, test_shaders().end());
  const auto glsl = shader_library().spirv("still_walk");
  const std::vector<gpu::StillWalk> expected = walk_still_points(test_context(), glsl, *on_gpu_, points);
  const std::vector<gpu::StillWalk> found = walk_still_points(test_context(), hlsl->spirv, *on_gpu_, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(found[i].lights, expected[i].lights);
    EXPECT_EQ(found[i].hash, expected[i].hash);
  }
}

/// On every path that walks lists; with a picture's list that is a tree itself.
TEST_P(StillLights, PictureOfATreeEqualsThatOfOneList) {
  make_tree();
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
  for (const ShadingPath path : WALKING) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    renderer.light_still(nullptr);
    const HdrImage reference = picture(renderer, brute_force(), {}, path);
    renderer.light_still(&*on_gpu_);
    for (const char* method : {"lamplight", "world-tree"})
      EXPECT_EQ(max_abs_difference(picture(renderer, *take(find_method(method)), {}, path), reference), 0.0F) << method;
  }
}

/// In GLSL and in HLSL; also where the budget holds no list, and every point walks every light.
TEST_P(StillLights, NothingIsMissedInATree) {
  for (const std::uint64_t budget : {WorldTreeInfo().budget, std::uint64_t{64}}) {
    make_tree(budget);
    EXPECT_EQ(tree_->counts().every_light, budget == 64);
    const Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
    const StillCheck check{.context = test_context(),
                           .shaders = shader_library(),
                           .triangles = {},
                           .lights = std::span(lights_).last(STILL),
                           .list = [&](const gpu::StillPoint& p) { return tree_->lights_at(p.position); },
                           .on_gpu = *on_gpu_};
    const std::vector<gpu::StillPoint> points = random_points_on(triangles_, 2000, 4);
    const StillFindings found = check_still_points(check, points);
    EXPECT_EQ(found.verdict(), Verdict::ok)
        << found.missed << " missed: " << found.first_miss << "; " << found.differing << " differ";
    EXPECT_GT(found.lighting, 0U);
    const auto hlsl = std::ranges::find(test_shaders(), "still_walk.hlsl", &ShaderCode::name);
    const auto in_hlsl = walk_still_points(test_context(), hlsl->spirv, *on_gpu_, points);
    const auto in_glsl = walk_still_points(test_context(), shader_library().spirv("still_walk"), *on_gpu_, points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(in_hlsl[i].hash, in_glsl[i].hash);
  }
}

/// The check finds what lists lack, and walks of other lists.
TEST_P(StillLights, TheCheckSeesFaults) {
  make({});
  const Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT);
  const auto still = std::span(lights_).last(STILL);
  const TriangleLists fewer =
      take(make_triangle_lists({.triangles = triangles_, .lights = still.first(STILL / 2), .slack_m = 0.01F}));
  const StillCheck check{.context = test_context(),
                         .shaders = shader_library(),
                         .triangles = triangles_,
                         .lights = still,
                         .list = [&](const gpu::StillPoint& p) { return lights_at(fewer, p.triangle, p.position); },
                         .on_gpu = *on_gpu_};
  const StillFindings found = check_still_points(check, random_points_on(triangles_, 500, 2));
  EXPECT_GT(found.missed, 0U);
  EXPECT_GT(found.differing, 0U);
}

/// Their ids lie between those of lights that move and of lights that stand still.
TEST_P(StillLights, DecalsKeepTheirIds) {
  const std::vector<gpu::DecalData> decals = pack(place_decals(scene_.scene, 20, 1));
  make(decals);
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT, 20);
  for (const ShadingPath path : {ShadingPath::forward, ShadingPath::deferred}) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    renderer.light_still(nullptr);
    const HdrImage reference = picture(renderer, brute_force(), decals, path);
    renderer.light_still(&*on_gpu_);
    EXPECT_EQ(max_abs_difference(picture(renderer, *take(find_method("lamplight")), decals, path), reference), 0.0F);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, StillLights, ::testing::Values("corridor", "atrium"),
                         [](const auto& test) { return test_name(test.param); });

/// The poles of spheres have such triangles. Which of its normals a point has, nothing tells.
TEST_F(GpuTest, PointsOfATriangleWithoutAreaMissOnlyWhatAllItsNormalsSee) {
  const Vec3 up{0.0F, 1.0F, 0.0F};
  const Vec3 down{0.0F, -1.0F, 0.0F};
  const DVec3 start{};
  const DVec3 end{1.0, 0.0, 0.0};
  const std::vector<StillTriangle> triangles{
      {.corners = {start, end, end}, .normals = {up, down, down}, .normal_tilt = 0.0F},
      {.corners = {start, end, end}, .normals = {up, up, up}, .normal_tilt = 0.0F},
      {.corners = {start, end, DVec3{1.0, 0.0, 1.0}}, .normals = {up, down, down}, .normal_tilt = 0.0F}};
  const std::vector<shared::Light> lights{pack(Light{.position = {0.5F, 1.0F, 0.0F}, .range = 5.0F})};
  const TriangleLists lists = take(make_triangle_lists({.triangles = triangles, .lights = lights, .slack_m = 0.01F}));
  const StillLists on_gpu(test_context(), gpu::STILL_TRIANGLES, 1, lists.words);
  const StillCheck check{.context = test_context(),
                         .shaders = shader_library(),
                         .triangles = triangles,
                         .lights = lights,
                         .list = [](const gpu::StillPoint&) { return std::vector<std::uint32_t>(); },
                         .on_gpu = on_gpu};
  const auto missed = [&](std::uint32_t triangle) {
    const gpu::StillPoint point{.position = Vec3{0.1F, 0.0F, 0.0F}, .triangle = triangle};
    return check_still_points(check, {&point, 1}).missed;
  };
  EXPECT_EQ(missed(0), 0U);
  EXPECT_EQ(missed(1), 1U);
  EXPECT_EQ(missed(2), 1U) << "its place says that it is near the first corner";
}

}  // namespace
}  // namespace lamp::app
