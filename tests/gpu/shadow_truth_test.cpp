// Shadows held against rays: what the numbers are where they are known, and that filters stay near the truth.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_truth.h"

#include "gpu/test_scenes.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 128;
constexpr std::uint32_t HEIGHT = 72;

ShadowFindings findings(const ShadowSettings& settings, const ShadowProgress& progress = {}) {
  const TestScene& scene = builtin_test_scene("corridor");
  const std::vector<shared::Light> lights =
      pack(place_lights(scene.air, {.count = 24, .spots = 0.5F, .min_range = 3.0F, .max_range = 8.0F}));
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT,
                    static_cast<std::uint32_t>(lights.size()));
  renderer.cast_shadows(settings);
  renderer.set_frame(view_of(scene.scene.cameras.front(), WIDTH, HEIGHT, "perspective"), lights);
  LightingInfo info{.method = take(find_method("tight")),
                    .width = WIDTH,
                    .height = HEIGHT,
                    .light_capacity = static_cast<std::uint32_t>(lights.size()),
                    .shadows = settings.filter};
  info.options = take(resolve_options(*info.method, {}));
  Lighting lighting(test_context().device(), shader_library(), info);
  static_cast<void>(renderer.render(lighting));  // draws the maps
  return check_shadows(renderer, shader_library(), scene.scene, lights, progress);
}

TEST_F(GpuTest, WithoutMapsAllThatRaysStopLeaks) {
  const ShadowFindings none = findings({.filter = ShadowFilter::hard, .budget_texels = 0});
  EXPECT_GT(none.pairs, 1000U);
  EXPECT_GT(none.in_shadow, 100U);
  EXPECT_LT(none.unclear, none.pairs / 50);
  EXPECT_EQ(none.all.leaks(), 1.0);
  EXPECT_EQ(none.all.false_shadows(), 0.0);
  EXPECT_EQ(none.away.leaks(), 1.0);
  EXPECT_GT(none.all.stopped, none.away.stopped) << "some lie at edges";
}

TEST_F(GpuTest, ShadowProgressGoesFromPairsToTheLastRay) {
  std::vector<std::string> parts;
  double last = 0.0;
  const ShadowFindings found = findings({.filter = ShadowFilter::hard}, [&](const std::string& what, double done) {
    if (parts.empty() || parts.back() != what) {
      parts.push_back(what);
      last = 0.0;
    }
    EXPECT_GT(done, last);
    EXPECT_LE(done, 1.0);
    last = done;
  });
  EXPECT_GT(found.pairs, 0U);
  EXPECT_EQ(parts, (std::vector<std::string>{"pairs of pixel and light", "rays"}));
  EXPECT_EQ(last, 1.0);
}

TEST_F(GpuTest, ShadowsAreNearTheTruth) {
  for (const PointShadows points : {PointShadows::faces, PointShadows::octahedron})
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm, ShadowFilter::evsm}) {
      SCOPED_TRACE(static_cast<int>(filter));
      const ShadowFindings found =
          findings({.filter = filter, .points = points, .atlas_size = 2048, .texels_per_pixel = 4.0F});
      const bool blurred = filter == ShadowFilter::vsm || filter == ShadowFilter::evsm;
      EXPECT_LT(found.all.leaks(), filter == ShadowFilter::hard ? 0.1 : blurred ? 0.5 : 0.25);
      EXPECT_LT(found.all.false_shadows(), blurred ? 0.05 : 0.02);
      EXPECT_LT(found.away.leaks(), found.all.leaks());
      EXPECT_LT(found.away.false_shadows(), blurred ? 0.03 : 0.01);
      EXPECT_EQ(found.lost, 0U) << "radial bounds cut what is lit";
      EXPECT_GT(found.dark, 100U);
      EXPECT_LE(found.cut, found.dark);
    }
}

}  // namespace
}  // namespace lamp::app
