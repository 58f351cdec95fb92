// Lights cut to what their shadow maps let them reach: the same picture, bit for bit, through every method, and fewer
// lights walked.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "gpu/in_turn.h"
#include "gpu/test_scenes.h"
#include "render/judgement.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 54;
constexpr std::uint32_t COUNT = 40;

class ShadowCut : public GpuTest, public ::testing::WithParamInterface<const char*> {};

std::uint64_t walked(Renderer& renderer, Lighting& lighting) {
  std::uint64_t sum = 0;
  for (const Visit& visit : renderer.visit_all(lighting)) sum += visit.visited;
  return sum;
}

/// Fragments walk longer than compute shaders take to compile: the path goes round with the method.
TEST_P(ShadowCut, ChangesNoPictureThroughAnyMethod) {
  constexpr std::array PATHS{ShadingPath::deferred, ShadingPath::forward, ShadingPath::tiled_deferred};
  const TestScene& scene = builtin_test_scene(GetParam());
  const View view = view_of(scene.scene.cameras.front(), WIDTH, HEIGHT, "perspective");
  const std::vector<shared::Light> lights =
      pack(place_lights(scene.air, {.count = COUNT, .spots = 0.5F, .min_range = 3.0F, .max_range = 10.0F}));
  std::size_t number = 0;
  for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf}) {
    const PointShadows points = filter == ShadowFilter::hard ? PointShadows::octahedron : PointShadows::faces;
    Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, COUNT);
    renderer.cast_shadows({.filter = filter, .points = points, .atlas_size = 2048, .texels_per_pixel = 4.0F});
    renderer.set_frame(view, lights);
    for (const Method& method : methods()) {
      if (method.approximate || !resolve_options(method, {"occlusion=radial"})) continue;
      if (number++ % 2 != (filter == ShadowFilter::hard ? 0 : 1)) continue;
      SCOPED_TRACE(fmt::format("{} {}", method.name, static_cast<int>(filter)));
      const auto lighting = [&](const char* occlusion) {
        LightingInfo info{.method = &method,
                          .width = WIDTH,
                          .height = HEIGHT,
                          .light_capacity = COUNT,
                          .path = PATHS[number % PATHS.size()],
                          .transparency = !scene.gpu.blended().empty(),
                          .shadows = filter};
        info.options = take(resolve_options(method, {fmt::format("occlusion={}", occlusion)}));
        return Lighting(test_context().device(), shader_library(), info);
      };
      Lighting whole = lighting("none");
      Lighting cut = lighting("radial");
      const HdrImage expected = renderer.render(whole).image;
      // Lists without an order are added up in another one each time.
      const Plan& plan = cut.runner().plan();
      const float tolerance = plan.ordered ? 0.0F : picture_tolerance(plan, expected);
      EXPECT_LE(max_abs_difference(renderer.render(cut).image, expected), tolerance);
      EXPECT_LE(walked(renderer, cut), walked(renderer, whole));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(In, ShadowCut, ::testing::Values("atrium", "corridor", "blocks"),
                         [](const auto& test) { return std::string(test.param); });

/// Meshes in place of spheres and cones, of each way to draw and to look at depth.
TEST_P(ShadowCut, OfProxiesChangesNoPicture) {
  const TestScene& scene = builtin_test_scene(GetParam());
  const View view = view_of(scene.scene.cameras.front(), 2 * WIDTH, 2 * HEIGHT, "perspective");
  const View parallel = view_of(scene.scene.cameras.front(), 2 * WIDTH, 2 * HEIGHT, "orthographic");
  const std::vector<shared::Light> lights =
      pack(place_lights(scene.air, {.count = COUNT, .spots = 0.5F, .min_range = 3.0F, .max_range = 10.0F}));
  const std::vector<std::pair<const char*, std::vector<std::string>>> ways{
      {"drobot-raster-tile", {"raster=full"}},
      {"drobot-raster-tile", {"raster=half-msaa", "depth=stencil"}},
      {"drobot-raster-tile", {"raster=full", "depth=test", "occlusion=radial"}},
      {"drobot-raster-tile", {"raster=conservative", "tile=16"}},
      {"drobot-raster-cluster", {"raster=full", "early=on"}},
      {"drobot-raster-cluster", {"raster=quarter-msaa", "tile=16"}},
      {"drobot-raster-cluster", {"raster=half-msaa", "occlusion=radial", "compact=off"}}};
  for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf}) {
    const PointShadows points = filter == ShadowFilter::pcf ? PointShadows::octahedron : PointShadows::faces;
    Renderer renderer(test_context(), shader_library(), scene.gpu, 2 * WIDTH, 2 * HEIGHT, COUNT);
    renderer.cast_shadows({.filter = filter, .points = points, .atlas_size = 2048, .texels_per_pixel = 4.0F});
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (!has_turn(i + (filter == ShadowFilter::hard ? 0 : 1), 2)) continue;
      renderer.set_frame(i % 3 == 2 ? parallel : view, lights);
      const auto& [name, settings] = ways[i];
      SCOPED_TRACE(fmt::format("{} {} {}", name, fmt::join(settings, " "), static_cast<int>(filter)));
      const auto lighting = [&, &method_name = name, &method_settings = settings](const char* proxy) {
        LightingInfo info{.method = take(find_method(method_name)),
                          .width = 2 * WIDTH,
                          .height = 2 * HEIGHT,
                          .light_capacity = COUNT,
                          .transparency = !scene.gpu.blended().empty(),
                          .shadows = filter};
        std::vector<std::string> all = method_settings;
        all.push_back(fmt::format("proxy={}", proxy));
        info.options = take(resolve_options(*info.method, all));
        return Lighting(test_context().device(), shader_library(), info);
      };
      Lighting whole = lighting("full");
      Lighting cut = lighting("cut");
      const HdrImage expected = renderer.render(whole).image;
      EXPECT_EQ(max_abs_difference(renderer.render(cut).image, expected), 0.0F);
      EXPECT_LE(walked(renderer, cut), walked(renderer, whole) * 21 / 20);
    }
  }
}

/// Of a light in a closed room nothing is left elsewhere.
TEST_F(GpuTest, CutLightsAreWalkedLess) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View view = view_of(scene.scene.cameras.front(), WIDTH, HEIGHT, "perspective");
  const std::vector<shared::Light> lights =
      pack(place_lights(scene.air, {.count = COUNT, .spots = 0.0F, .min_range = 3.0F, .max_range = 10.0F}));
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, COUNT);
  renderer.cast_shadows({.filter = ShadowFilter::hard, .atlas_size = 4096, .texels_per_pixel = 8.0F});
  renderer.set_frame(view, lights);
  for (const char* name : {"tight", "clustered", "lamplight", "drobot-zbin", "drobot-raster-tile"}) {
    const auto sum = [&](const char* occlusion) {
      LightingInfo info{.method = take(find_method(name)),
                        .width = WIDTH,
                        .height = HEIGHT,
                        .light_capacity = COUNT,
                        .shadows = ShadowFilter::hard};
      info.options = take(resolve_options(*info.method, {fmt::format("occlusion={}", occlusion)}));
      Lighting lighting(test_context().device(), shader_library(), info);
      static_cast<void>(renderer.render(lighting));
      return walked(renderer, lighting);
    };
    EXPECT_LT(sum("radial"), sum("none")) << name;
  }
}

/// Where maps and raster are fine enough, a mesh is much less than its sphere.
TEST_F(GpuTest, CutProxiesAreWalkedLess) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View view = view_of(scene.scene.cameras.front(), 2 * WIDTH, 2 * HEIGHT, "perspective");
  const std::vector<shared::Light> lights =
      pack(place_lights(scene.air, {.count = COUNT, .spots = 0.5F, .min_range = 3.0F, .max_range = 10.0F}));
  Renderer renderer(test_context(), shader_library(), scene.gpu, 2 * WIDTH, 2 * HEIGHT, COUNT);
  renderer.cast_shadows({.filter = ShadowFilter::hard, .atlas_size = 4096, .texels_per_pixel = 4.0F});
  renderer.set_frame(view, lights);
  for (const char* name : {"drobot-raster-tile", "drobot-raster-cluster"}) {
    const auto sum = [&](const char* proxy) {
      LightingInfo info{.method = take(find_method(name)),
                        .width = 2 * WIDTH,
                        .height = 2 * HEIGHT,
                        .light_capacity = COUNT,
                        .shadows = ShadowFilter::hard};
      info.options = take(resolve_options(*info.method, {"raster=full", fmt::format("proxy={}", proxy)}));
      Lighting lighting(test_context().device(), shader_library(), info);
      static_cast<void>(renderer.render(lighting));
      return walked(renderer, lighting);
    };
    EXPECT_LT(sum("cut"), sum("full") * 9 / 10) << name;
  }
}

}  // namespace
}  // namespace lamp::app
