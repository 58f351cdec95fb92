// Rasterised culling where sampling is hardest: lights smaller than a pixel, needles, lights across the near plane and
// around the eye, at every resolution, for every projection. Nothing may be missed.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 101;
constexpr std::uint32_t HEIGHT = 59;
constexpr std::uint32_t LIGHTS = 400;

/// The position that a pixel shows, and how large a pixel is there.
struct Seen {
  glm::vec3 position;
  float pixel_m;
};

std::vector<Seen> seen_points(const View& view, std::span<const float> depth) {
  std::vector<Seen> seen;
  for (std::uint32_t y = 0; y < view.height(); ++y) {
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      const float d = depth[std::size_t{y} * view.width() + x];
      if (d <= 0.0F) continue;
      const glm::dvec2 pixel(x, y);
      const double z = view.z_view(d);
      const double size =
          glm::distance(glm::dvec3(view.view_position(pixel, z)), glm::dvec3(view.view_position(pixel + 1.0, z)));
      seen.push_back({glm::vec3(view.world_position(x, y, d)), static_cast<float>(size)});
    }
  }
  return seen;
}

/// Lights that reach a seen point, and little else.
std::vector<shared::Light> slight_lights(const View& view, const std::vector<Seen>& seen,
                                         std::uint32_t count = LIGHTS) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const glm::vec3 eye(glm::dmat4(view.world_from_view())[3]);
  const auto near_m = static_cast<float>(view.z_view(1.0));
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Seen& at = seen[random() % seen.size()];
    const glm::vec3 off = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.499F);
    Light light{.position = at.position, .intensity = 5.0F};
    if (i % 4 == 0) {  // a share of a pixel
      light.range = at.pixel_m * (0.01F + unit(random));
      light.position = at.position + off * (light.range * 0.9F * unit(random));
    } else if (i % 4 == 1) {  // a needle through the point
      light.type = LightType::spot;
      light.range = 30.0F * unit(random) + 0.1F;
      light.position = at.position - off * (light.range * 0.9F * unit(random));
      light.direction = off;
      light.outer_angle = 0.001F + 0.03F * unit(random);
    } else if (i % 4 == 2) {  // across the near plane, wide or narrow
      light.position = eye + off * (2.0F * near_m * unit(random));
      light.range = glm::distance(glm::vec3(light.position), at.position) * (0.9F + 0.3F * unit(random));
      if (unit(random) < 0.7F) light.type = LightType::spot;
      light.direction = at.position - glm::vec3(light.position);
      light.outer_angle = 1.5707963F * unit(random);
    } else {  // one whose surface passes the point
      light.range = 20.0F * unit(random);
      light.position = at.position + off * (light.range * (0.999F + 0.002F * unit(random)));
      if (unit(random) < 0.5F) light.type = LightType::spot;
      light.direction = -off;
      light.outer_angle = 1.5707963F;
    }
    lights.push_back(light);
  }
  return pack(lights);
}

/// Every resolution with every way to use depth; none for methods that draw no lights.
std::vector<std::vector<std::string>> raster_settings(const Method& method) {
  const auto choices = [&](std::string_view key) {
    const auto spec = std::ranges::find(method.options, key, &OptionSpec::key);
    return spec == method.options.end() ? std::vector<std::string_view>{} : spec->choices;
  };
  std::vector<std::vector<std::string>> all;
  for (const std::string_view raster : choices("raster"))
    for (const char* key : {"depth", "early"})
      for (const std::string_view value : choices(key))
        all.push_back({fmt::format("raster={}", raster), fmt::format("{}={}", key, value)});
  return all;
}

class Proxies : public GpuTest {
 protected:
  /// Every way to rasterise, in every projection, over a picture with so many slight lights.
  static void expect_no_miss(glm::uvec2 size, std::uint32_t count) {
    const TestScene& scene = builtin_test_scene("posts");
    for (const std::string_view projection : tested_projections()) {
      const View view = view_of(find_camera(scene.scene, ""), size.x, size.y, projection);
      Renderer renderer(test_context(), shader_library(), scene.gpu, size.x, size.y, count);
      const LitCase dark = make_case(renderer, view, {});
      const LitCase lit = make_case(renderer, view, slight_lights(view, seen_points(view, dark.depth), count));
      EXPECT_GT(lit.truth.lights.size(), count / 2);
      for (const Method& method : methods()) {
        for (const std::vector<std::string>& settings : raster_settings(method)) {
          SCOPED_TRACE(fmt::format("{}, {} {}", projection, method.name, fmt::join(settings, " ")));
          check_method(renderer, lit, {.method = &method, .settings = settings, .light_capacity = count});
        }
      }
    }
  }
};

TEST_F(Proxies, MissNoLightHoweverSlight) { expect_no_miss({WIDTH, HEIGHT}, LIGHTS); }

// For devices that take long for a fragment: SwiftShader, minutes for the picture above.
TEST_F(Proxies, MissNoLightInASmallPicture) { expect_no_miss({51, 31}, LIGHTS / 4); }

/// What the method walks with each value of the option, in the order of the values.
std::vector<std::uint64_t> walked_with(Renderer& renderer, const LitCase& lit, std::string_view method,
                                       std::string_view raster, std::string_view key,
                                       std::initializer_list<std::string_view> values) {
  std::vector<std::uint64_t> walked;
  for (const std::string_view value : values) {
    const Candidate candidate{.method = take(find_method(method)),
                              .settings = {fmt::format("raster={}", raster), fmt::format("{}={}", key, value)},
                              .light_capacity = LIGHTS};
    walked.push_back(check_method(renderer, lit, candidate).evaluations);
  }
  return walked;
}

TEST_F(Proxies, EachUseOfDepthLeavesMoreOut) {
  const std::uint32_t bits = test_context().device().traits.sub_pixel_bits;
  if (bits < 8) GTEST_SKIP() << "the device has " << bits << " sub-pixel bits: faces' depths are not used below 8";
  const TestScene& scene = builtin_test_scene("posts");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, LIGHTS);
  const LitCase dark = make_case(renderer, view, {});
  const LitCase lit = make_case(renderer, view, slight_lights(view, seen_points(view, dark.depth)));
  for (const std::string_view raster : {"full", "half-msaa", "quarter-msaa"}) {
    SCOPED_TRACE(raster);
    const auto tiles = walked_with(renderer, lit, "drobot-raster-tile", raster, "depth", {"test", "bounds", "stencil"});
    EXPECT_GE(tiles[0], tiles[1]);
    EXPECT_GT(tiles[1], tiles[2]);
    const auto clusters = walked_with(renderer, lit, "drobot-raster-cluster", raster, "early", {"off", "on"});
    EXPECT_GE(clusters[0], clusters[1]);
  }
}

// The source's walk, which may end at a gap. How often it does is the device's; that it brings no more, and that the
// plan owns up to it, is ours.
TEST_F(Proxies, AWalkToTheFirstMarkBringsNoMoreAndSaysThatItMayMiss) {
  const TestScene& scene = builtin_test_scene("posts");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, LIGHTS);
  const LitCase dark = make_case(renderer, view, {});
  const LitCase lit = make_case(renderer, view, slight_lights(view, seen_points(view, dark.depth)));
  const auto walked =
      walked_with(renderer, lit, "drobot-raster-cluster", "quarter-msaa", "mark", {"farthest", "first"});
  EXPECT_LE(walked[1], walked[0]);
  EXPECT_GT(walked[1], 0U);
}

// Glass in the atrium lies before the depth buffer's surfaces, where an early end leaves lights out.
TEST_F(Proxies, AnEarlyEndDoesNotDarkenGlass) {
  const TestScene& scene = builtin_test_scene("atrium");
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, "camera");
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, LIGHTS);
  const LitCase dark = make_case(renderer, view, {});
  const LitCase lit = make_case(renderer, view, slight_lights(view, seen_points(view, dark.depth)));
  const auto info = [&](std::string_view method, const std::vector<std::string>& settings) {
    const Method& row = *take(find_method(method));
    return LightingInfo{.method = &row,
                        .options = take(resolve_options(row, settings)),
                        .width = WIDTH,
                        .height = HEIGHT,
                        .light_capacity = LIGHTS,
                        .transparency = true};
  };
  ASSERT_FALSE(scene.gpu.blended().empty());
  Lighting all(renderer.device(), shader_library(), info("all", {}));
  Lighting early(renderer.device(), shader_library(), info("drobot-raster-cluster", {"early=on"}));
  const HdrImage expected = renderer.render(all).image;
  EXPECT_EQ(max_abs_difference(renderer.render(early).image, expected), 0.0F);
}

}  // namespace
}  // namespace lamp::app
