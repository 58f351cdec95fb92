// Shadows held against rays: what the numbers are where they are known, and that filters stay near the truth.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_truth.h"

#include "gpu/hall.h"
#include "gpu/test_scenes.h"
#include "render/scene_occluders.h"
#include "render/shadow_pairs.h"
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
  return check_shadows(renderer, shader_library(), scene_occluders(scene.scene), lights, progress);
}

TEST_F(GpuTest, WithoutMapsAllThatRaysStopLeaks) {
  const ShadowFindings none = findings({.filter = ShadowFilter::hard, .budget_texels = 0});
  EXPECT_GT(none.pairs, 1000U);
  EXPECT_GT(none.in_shadow, 100U);
  EXPECT_LT(none.unclear, none.pairs / 50);
  EXPECT_EQ(none.all.leaks(), 1.0);
  EXPECT_EQ(none.all.false_shadows(), 0.0);
  EXPECT_EQ(none.away.leaks(), 1.0);
  EXPECT_EQ(none.beyond.stopped, 0.0) << "no texel has a say";
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
  for (const PointShadows points : {PointShadows::faces, PointShadows::octahedron}) {
    double vsm_bleeding = 0.0;  // beyond its reach
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm, ShadowFilter::evsm}) {
      SCOPED_TRACE(static_cast<int>(filter));
      const ShadowFindings found =
          findings({.filter = filter, .points = points, .atlas_size = 2048, .texels_per_pixel = 4.0F});
      const bool blurred = filter == ShadowFilter::vsm || filter == ShadowFilter::evsm;
      EXPECT_LT(found.all.leaks(), filter == ShadowFilter::hard ? 0.1 : blurred ? 0.5 : 0.25);
      EXPECT_LT(found.all.false_shadows(), blurred ? 0.05 : 0.02);
      EXPECT_LT(found.away.leaks(), found.all.leaks());
      EXPECT_LT(found.away.false_shadows(), blurred ? 0.03 : 0.01);
      EXPECT_GT(found.stopped_beyond(), blurred ? 0.2 : 0.5);
      EXPECT_LT(found.stopped_beyond(), 1.0);
      EXPECT_LE(found.beyond.leaks(), blurred ? 0.1 : 0.0) << "what compares depths does not bleed";
      EXPECT_LE(found.beyond.false_shadows(), blurred ? 0.01 : 0.0);
      EXPECT_EQ(found.lost, 0U) << "radial bounds cut what is lit";
      EXPECT_GT(found.dark, 100U);
      EXPECT_LE(found.cut, found.dark);
      EXPECT_GT(found.behind, 100U);
      EXPECT_LE(found.cut_behind, found.behind);
      if (filter == ShadowFilter::vsm) vsm_bleeding = found.beyond.leaks();
      if (filter == ShadowFilter::evsm) {
        EXPECT_LE(found.beyond.leaks(), 0.25 * vsm_bleeding);
      }
      EXPECT_EQ(found.all.bled > 0.0, blurred);
    }
  }
}

/// A light above a square that floats over a floor: its shadow is a square, too.
TEST_F(GpuTest, TexelsOfTheFilterDifferAtTheEdgeOfAWallsShadow) {
  constexpr float WALL_M = 3.0F;  // of the hall's ceiling
  constexpr float LIGHT_M = 4.5F;
  constexpr float HALF_SHADOW_M = 1.2F;
  Scene scene = hall(HALF_SHADOW_M * (LIGHT_M - WALL_M) / LIGHT_M);
  scene.materials[0] = {.roughness = 1.0F};
  const GpuScene on_gpu(test_context(), scene);
  const View view = view_of(scene.cameras.front(), WIDTH, HEIGHT, "perspective");
  const std::vector<shared::Light> lights =
      pack(std::vector<Light>{{.position = {0.0F, LIGHT_M, 0.0F}, .range = 20.0F}});
  for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm, ShadowFilter::evsm}) {
    SCOPED_TRACE(static_cast<int>(filter));
    Renderer renderer(test_context(), shader_library(), on_gpu, WIDTH, HEIGHT, 1);
    renderer.cast_shadows({.filter = filter, .texels_per_pixel = 4.0F});
    renderer.set_frame(view, lights);
    renderer.need_surfaces();
    const std::vector<float> depth = renderer.read_depth();
    std::vector<gpu::ShadowPair> pairs(depth.size());
    for (std::uint32_t i = 0; i < pairs.size(); ++i) pairs[i] = {.pixel = i};
    const std::vector<gpu::ShadowAnswer> answers = ask_shadows(renderer, shader_library(), pairs, ShadowAsked::texels);
    const shared::ShadowMap& map = renderer.shadows()->maps()[0];
    ASSERT_GE(map.side, 64U);
    const double taps = filter == ShadowFilter::hard ? 0.0 : filter == ShadowFilter::pcf ? 2.0 : 13.0;
    std::array<std::size_t, 3> expected{};
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      const glm::dvec3 at = view.world_position(i % WIDTH, i / WIDTH, double{depth[i]});
      const double past_edge =
          (std::max(std::abs(at.x), std::abs(at.z)) - HALF_SHADOW_M) / LIGHT_M * map.scale;  // texels
      std::uint32_t texels = gpu::TEXELS_DIFFER;
      if (std::abs(past_edge) > taps + 2.0)
        texels = past_edge < 0.0 ? gpu::TEXELS_DARK : gpu::TEXELS_LIT;
      else if (std::abs(past_edge) > taps - 2.0)
        continue;  // texels are too coarse to say
      ++expected[texels];
      ASSERT_EQ(answers[i].texels, texels) << past_edge << " texels past the edge";
      if (texels == gpu::TEXELS_DIFFER) {
        ASSERT_GT(answers[i].compared, 0.0F);
        ASSERT_LT(answers[i].compared, 1.0F);
      } else {
        ASSERT_NEAR(answers[i].compared, texels == gpu::TEXELS_DARK ? 0.0F : 1.0F, 1e-5F);
      }
    }
    EXPECT_GT(expected[gpu::TEXELS_DARK], 100U);
    EXPECT_GT(expected[gpu::TEXELS_LIT], 100U);
    EXPECT_EQ(expected[gpu::TEXELS_DIFFER] > 0, taps > 2.0);
  }
}

}  // namespace
}  // namespace lamp::app
