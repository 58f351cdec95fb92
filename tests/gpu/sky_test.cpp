// Tiles that the depth buffer leaves empty list nothing, whatever the preset; and a transparent surface there is lit
// nevertheless.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/over_depth.h"
#include "gpu/test_surfaces.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t WIDTH = 160;
constexpr std::uint32_t HEIGHT = 96;
constexpr std::uint32_t COUNT = 40;
constexpr std::uint32_t LARGEST_TILE_PX = 32;

/// Every row that culls tiles.
std::vector<const Method*> tiled_rows() {
  std::vector<const Method*> rows;
  for (const Method& method : methods())
    if (method.result.starts_with("tile_")) rows.push_back(&method);
  return rows;
}

/// A row without depth bounds cannot know where the sky is.
bool looks_at_depth(const Method& method) {
  if (std::ranges::find(method.options, "bounds", &OptionSpec::key) == method.options.end()) return method.needs_depth;
  return take(resolve_options(method, {})).word("bounds") != "none";
}

/// Points and spots whose spheres cover the whole picture, all around the plane z = 0 before the camera.
std::vector<shared::Light> covering_lights() {
  std::vector<Light> lights(COUNT);
  for (std::uint32_t i = 0; i < COUNT; ++i) {
    const float share = static_cast<float>(i) / COUNT;
    lights[i].position = {2.0F * share - 1.0F, 1.0F - share, 1.0F + share};
    lights[i].range = 40.0F;
    if (i % 3 != 0) continue;
    lights[i].type = LightType::spot;
    lights[i].direction = {0.0F, 0.0F, -1.0F};
    lights[i].outer_angle = 1.5F;
  }
  return pack(lights);
}

View camera_view(const Scene& scene) { return view_of(scene.cameras.front(), WIDTH, HEIGHT, "camera"); }

float device_depth(const View& view, double z_view) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(0.0, 0.0, -z_view, 1.0);
  return static_cast<float>(clip.z / clip.w);
}

/// The left part of the picture is sky, to a column that no tile size divides; the rest lies 1 m to 9 m ahead.
constexpr std::uint32_t FIRST_COVERED = 3 * LARGEST_TILE_PX + 5;
std::vector<float> half_a_sky(const View& view) {
  std::vector<float> depth(std::size_t{WIDTH} * HEIGHT, 0.0F);
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = FIRST_COVERED; x < WIDTH; ++x)
      depth[std::size_t{y} * WIDTH + x] = device_depth(view, 1.0 + 8.0 * (x + y) / (WIDTH + HEIGHT));
  return depth;
}

Plan plan_of(const Method& method) {
  return take(make_plan(method, {.width = WIDTH,
                                 .height = HEIGHT,
                                 .light_capacity = COUNT,
                                 .options = take(resolve_options(method, {})),
                                 .traits = test_context().device().traits}));
}

class Sky : public GpuTest {};

TEST_F(Sky, EmptyTilesListNothing) {
  const Scene scene = wall_scene({});
  const View view = camera_view(scene);
  OverDepth over(view, half_a_sky(view), covering_lights());
  for (const Method* method : tiled_rows()) {
    vulkan::PlanRunner runner =
        take(vulkan::PlanRunner::create(test_context().device(), plan_of(*method), shader_library().source()));
    for (const Passes which : {Passes::separate, Passes::fused}) {
      if (which == Passes::fused && !runner.plan().fused) continue;
      SCOPED_TRACE(std::string(method->name) + (which == Passes::fused ? ", fused" : ""));
      const std::vector<std::uint32_t> counts = over.per_pixel("count_everywhere", runner, which);
      std::uint64_t in_sky = 0;
      std::uint64_t elsewhere = 0;
      for (std::uint32_t y = 0; y < HEIGHT; ++y)
        for (std::uint32_t x = 0; x < WIDTH; ++x) {
          const std::uint32_t count = counts[std::size_t{y} * WIDTH + x];
          if (x < FIRST_COVERED / LARGEST_TILE_PX * LARGEST_TILE_PX) in_sky += count;
          if (x >= FIRST_COVERED) elsewhere += count;
        }
      if (looks_at_depth(*method))
        EXPECT_EQ(in_sky, 0U);
      else
        EXPECT_GT(in_sky, 0U);
      EXPECT_GT(elsewhere, 0U);
    }
  }
}

TEST_F(Sky, ATransparentSurfaceBeforeItIsLit) {
  const Scene scene = wall_scene({.base_color = glm::vec4(0.8F, 0.7F, 0.6F, 0.5F), .alpha_mode = AlphaMode::blend});
  const GpuScene gpu(test_context(), scene);
  Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, COUNT);
  renderer.set_frame(camera_view(scene), covering_lights());
  const auto picture = [&](const Method& method, ShadingPath path) {
    Lighting lighting(renderer.device(), shader_library(),
                      {.method = &method,
                       .options = take(resolve_options(method, {})),
                       .width = WIDTH,
                       .height = HEIGHT,
                       .light_capacity = COUNT,
                       .path = path,
                       .transparency = true});
    return renderer.render(lighting).image;
  };
  const HdrImage reference = picture(brute_force(), ShadingPath::deferred);
  const std::vector<float> depth = renderer.read_depth();
  ASSERT_TRUE(std::ranges::all_of(depth, [](float d) { return d == 0.0F; })) << "the picture should be all sky";
  const glm::vec4 middle = reference.pixels[std::size_t{HEIGHT / 2} * WIDTH + WIDTH / 2];
  ASSERT_GT(middle.r, 0.01F);
  std::size_t number = 0;
  for (const Method* method : tiled_rows()) {
    for (const ShadingPath path : {ShadingPath::forward, ShadingPath::deferred, ShadingPath::tiled_deferred}) {
      if (!has_turn(number++, 2)) continue;
      SCOPED_TRACE(std::string(method->name) + " " + std::string(path_names()[static_cast<std::size_t>(path)]));
      EXPECT_LE(max_abs_difference(picture(*method, path), reference), picture_tolerance(plan_of(*method), reference));
    }
  }
}

}  // namespace
}  // namespace lamp::app
