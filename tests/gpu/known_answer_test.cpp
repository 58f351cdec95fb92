// Pictures against closed forms: the plane and a wall under known lights; emission, ambient, sun, sky, cut-outs,
// blending.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "gpu/test_surfaces.h"
#include "render/antialias.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 64;
constexpr std::uint32_t HEIGHT = 48;
constexpr ShadingPath PATHS[] = {ShadingPath::forward, ShadingPath::tiled_deferred, ShadingPath::deferred,
                                 ShadingPath::standard_deferred};

/// Forward shading has 32-bit inputs. The G-buffer keeps base colour in 8 bits of sRGB, whose steps are 1.2 % wide at
/// middle grey (0.5 lies between two of them), normals in 2 x 16, roughness in 8 bits, emission in half floats.
double tolerance(ShadingPath path) { return path == ShadingPath::forward ? 1e-3 : 8e-3; }

/// A scene lit by every path through one method.
struct Pictures {
  Pictures(const Scene& scene, std::string_view projection = "camera", std::string_view method = "clustered")
      : gpu(test_context(), scene), view(view_of(find_camera(scene, ""), WIDTH, HEIGHT, projection)) {
    const std::vector<shared::Light> lights = pack(scene.lights);
    const auto count = static_cast<std::uint32_t>(lights.size());
    Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, count);
    for (const ShadingPath path : PATHS) {
      Lighting lighting(renderer.device(), shader_library(),
                        {.method = take(find_method(method)),
                         .options = take(resolve_options(*take(find_method(method)), {})),
                         .width = WIDTH,
                         .height = HEIGHT,
                         .light_capacity = count,
                         .path = path,
                         .transparency = !gpu.blended().empty()});
      renderer.set_frame(view, lights);
      images.push_back(renderer.render(lighting).image);
    }
  }
  [[nodiscard]] glm::dvec3 at(ShadingPath path, glm::uvec2 pixel) const {
    return {images[static_cast<std::size_t>(path)].pixels[pixel.y * WIDTH + pixel.x]};
  }

  GpuScene gpu;
  View view;
  std::vector<HdrImage> images;
};

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], relative * expected[c]) << "channel " << c;
}

template <class Check>
void for_each_path(Check check) {
  for (const ShadingPath path : PATHS) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    check(path);
  }
}

class KnownAnswer : public GpuTest {};

TEST_F(KnownAnswer, PlaneUnderItsLight) {
  const std::uint32_t bits = test_context().device().traits.sub_pixel_bits;
  if (bits < 8) GTEST_SKIP() << "the device has " << bits << " sub-pixel bits: it draws the plane's corners elsewhere";
  const Scene& scene = builtin_test_scene("plane").scene;
  const Material& material = scene.materials[0];
  for (const std::string_view projection : tested_projections()) {
    SCOPED_TRACE(projection);
    const Pictures pictures(scene, projection);
    for_each_path([&](ShadingPath path) {
      std::uint32_t seen = 0;
      for (const glm::uvec2 pixel : {glm::uvec2(32, 24), {32, 30}, {10, 40}, {50, 28}, {60, 47}, {3, 33}}) {
        SCOPED_TRACE(fmt::format("pixel ({}, {})", pixel.x, pixel.y));
        const glm::dvec3 point = seen_point(pictures.view, pixel, {0.0, 1.0, 0.0});
        const double z_view = -(glm::dmat4(pictures.view.view_from_world()) * glm::dvec4(point, 1.0)).z;
        if (std::abs(point.x) > 9.9 || std::abs(point.z) > 9.9 || z_view < pictures.view.z_view(1.0)) continue;
        ++seen;
        const Reflection surface{.normal = {0.0, 1.0, 0.0},
                                 .base_color = glm::dvec3(material.base_color),
                                 .metallic = material.metallic,
                                 .roughness = material.roughness};
        expect_near(pictures.at(path, pixel), lit_by_point(scene.lights[0], point, surface, pictures.view),
                    tolerance(path));
      }
      EXPECT_GE(seen, 4);
    });
  }
}

TEST_F(KnownAnswer, PlaneIsBrightestBelowItsLightByTheInverseSquare) {
  // By hand: 100 cd, 2 m above, seen from straight above: F = 0.04, D V = 1 / pi / 4 n.l n.v with n.l = n.v = 1.
  Scene scene = builtin_test_scene("plane").scene;
  scene.cameras[0].world_from_camera = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 9, 0, 1}};
  const Pictures pictures(scene);
  const double base = scene.materials[0].base_color.r;
  const double brdf = 0.96 * base / std::numbers::pi + 0.04 * (1.0 / std::numbers::pi) * 0.25;
  for_each_path([&](ShadingPath path) {
    const glm::dvec3 middle = 0.25 * (pictures.at(path, {31, 23}) + pictures.at(path, {32, 23}) +
                                      pictures.at(path, {31, 24}) + pictures.at(path, {32, 24}));
    expect_near(middle, glm::dvec3(25.0 * brdf), 0.02);
  });
}

TEST_F(KnownAnswer, GlossyMetalRangeWindowAndColour) {
  const Material metal{.base_color = glm::vec4(1.0F, 0.5F, 0.25F, 1.0F), .metallic = 1.0F, .roughness = 0.6F};
  Scene scene = wall_scene(metal);
  Light light;
  light.position = {0.5F, 0.25F, 1.5F};
  light.range = 3.0F;  // so near that the window matters
  light.color = {1.0F, 0.8F, 0.6F};
  light.intensity = 12.0F;
  scene.lights = {light};
  const Pictures pictures(scene);
  const Reflection surface{.base_color = glm::dvec3(metal.base_color), .metallic = 1.0, .roughness = metal.roughness};
  for_each_path([&](ShadingPath path) {
    for (const glm::uvec2 pixel : {glm::uvec2(32, 24), {40, 20}, {20, 30}, {60, 24}}) {
      const glm::dvec3 point = seen_point(pictures.view, pixel, {0.0, 0.0, 1.0});
      // Roughness 0.6 is 153 / 255 exactly; the base colour's 8 bits remain.
      expect_near(pictures.at(path, pixel), lit_by_point(light, point, surface, pictures.view), tolerance(path));
    }
  });
}

TEST_F(KnownAnswer, SpotIsDarkOutsideItsConeAndFullInside) {
  Scene scene = wall_scene({});
  Light spot;
  spot.type = LightType::spot;
  spot.position = {0.0F, 0.0F, 2.0F};
  spot.range = 100.0F;
  spot.intensity = 10.0F;
  spot.outer_angle = 0.5F;  // a circle of 1.09 m on the wall
  spot.inner_angle = 0.3F;  // full within 0.62 m
  scene.lights = {spot};
  const Pictures pictures(scene);
  Light point = spot;
  point.type = LightType::point;
  for_each_path([&](ShadingPath path) {
    for (std::uint32_t x = 0; x < WIDTH; ++x) {
      const glm::dvec3 at = seen_point(pictures.view, {x, 24}, {0.0, 0.0, 1.0});
      const double angle = std::atan2(glm::length(glm::dvec2(at)), 2.0);
      const glm::dvec3 found = pictures.at(path, {x, 24});
      if (angle > 0.5 + 1e-5) expect_near(found, glm::dvec3(0.0), 0.0);
      if (angle < 0.3 - 1e-5) expect_near(found, lit_by_point(point, at, {}, pictures.view), tolerance(path));
      if (angle > 0.3 && angle < 0.5) {
        const double window = (std::cos(angle) - std::cos(0.5)) / (std::cos(0.3) - std::cos(0.5));
        expect_near(found, lit_by_point(point, at, {}, pictures.view) * window * window, 2.0 * tolerance(path));
      }
    }
  });
}

/// A wall that a camera sees from 40 micrometres, and a light 4 before it that reaches 8.
Scene tiny_scene(const Light& light) {
  Scene scene = wall_scene({}, 1e-3F);
  scene.cameras[0].world_from_camera[3] = glm::vec4(0.0F, 0.0F, 4e-5F, 1.0F);
  scene.cameras[0].near_m = 1e-6F;
  scene.lights = {light};
  scene.lights[0].position = {0.0F, 0.0F, 4e-6F};
  scene.lights[0].range = 8e-6F;
  scene.lights[0].intensity = 1e-8F;
  return scene;
}

TEST_F(KnownAnswer, LightsOfATinyRangeAreLitToTheirRange) {
  Light spot;
  spot.type = LightType::spot;
  spot.outer_angle = 1.3F;
  spot.inner_angle = 1.2F;  // the wall within the range is within that
  for (const Light& light : {Light{}, spot}) {
    SCOPED_TRACE(static_cast<int>(light.type));
    const Scene scene = tiny_scene(light);
    const Pictures pictures(scene);
    for_each_path([&](ShadingPath path) {
      std::uint32_t lit = 0;
      for (std::uint32_t x = 0; x < WIDTH; ++x) {
        const glm::dvec3 at = seen_point(pictures.view, {x, 24}, {0.0, 0.0, 1.0});
        const double distance = glm::length(glm::dvec3(scene.lights[0].position) - at);
        const glm::dvec3 found = pictures.at(path, {x, 24});
        if (distance > 8.01e-6) expect_near(found, glm::dvec3(0.0), 0.0);
        if (distance > 7.9e-6) continue;
        ++lit;
        // Nearer than 0.1 mm no light is brighter than there.
        const double dimmer = distance * distance / 1e-8;
        expect_near(found, lit_by_point(scene.lights[0], at, {}, pictures.view) * dimmer, tolerance(path));
      }
      EXPECT_GT(lit, 10U);
    });
  }
}

TEST_F(KnownAnswer, EmissionAmbientSunAndSky) {
  const glm::vec3 emitted(0.5F, 2.0F, 7.0F);
  Scene scene = wall_scene({.emissive = emitted}, 1.0F);
  scene.sky = {0.1F, 0.2F, 0.7F};
  scene.ambient = {0.3F, 0.6F, 0.9F};
  scene.directional_lights = {{.direction = {0.0F, 0.0F, -1.0F}, .illuminance = {3.0F, 2.0F, 1.0F}}};
  const Pictures pictures(scene);
  const glm::uvec2 pixel(33, 22);
  const glm::dvec3 point = seen_point(pictures.view, pixel, {0.0, 0.0, 1.0});
  const Reflection sunlit{.to_eye = glm::normalize(glm::dvec3(glm::dmat4(pictures.view.world_from_view())[3]) - point)};
  // White, rough and seen from straight before it reflects 0.972 of what arrives from everywhere: 0.96 by its diffuse
  // part, and 0.04 times 0.307 by its specular one (brdf_test.cpp); the fit says 0.973.
  const glm::dvec3 expected = glm::dvec3(emitted) + 0.973 * glm::dvec3(scene.ambient) / std::numbers::pi +
                              glm::dvec3(scene.directional_lights[0].illuminance) * reflected(sunlit);
  for_each_path([&](ShadingPath path) {
    expect_near(pictures.at(path, pixel), expected, 1e-3);
    EXPECT_EQ(pictures.at(path, {0, 0}), glm::dvec3(scene.sky));
  });
}

/// Left half opaque, right half clear.
Image half_clear() {
  return {.name = "half", .width = 2, .height = 1, .rgba = {255, 255, 255, 255, 255, 255, 255, 0}, .srgb = true};
}

TEST_F(KnownAnswer, MaskCutsItsHoles) {
  Material masked{.emissive = glm::vec3(1.0F), .alpha_mode = AlphaMode::mask};
  masked.base_color_texture = {.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp, .nearest = true};
  Scene scene = wall_scene(masked, 1.0F);
  scene.images.push_back(half_clear());
  scene.sky = {0.25F, 0.5F, 0.75F};
  const Pictures pictures(scene);
  for_each_path([&](ShadingPath path) {
    expect_near(pictures.at(path, {30, 24}), glm::dvec3(1.0), 1e-6);
    EXPECT_EQ(pictures.at(path, {34, 24}), glm::dvec3(scene.sky));
  });
}

TEST_F(KnownAnswer, SeveralSamplesShowHowMuchOfAPixelIsCovered) {
  const Scene scene = wall_scene({.base_color = glm::vec4(0, 0, 0, 1), .emissive = glm::vec3(1.0F)}, 1.03F);
  const GpuScene gpu(test_context(), scene);
  Renderer renderer(test_context(), shader_library(), gpu, WIDTH, HEIGHT, 0);
  const View view = view_of(find_camera(scene, ""), WIDTH, HEIGHT, "camera");
  renderer.set_frame(view, {});
  Lighting lighting = make_lighting(renderer, {.method = &brute_force()});
  const HdrImage image = render_samples(renderer, lighting, {}, {}, {.samples = 32}).image;
  // The wall is a square around the axis: how far it reaches from the picture's middle, in pixels.
  const double half_px = 1.03 / (view.view_position({1.0, 0.0}, 4.0).x - view.view_position({0.0, 0.0}, 4.0).x);
  std::uint32_t partly = 0;
  const auto covered = [half_px](std::uint32_t i, std::uint32_t size) {
    const double from_middle = std::abs(i + 0.5 - 0.5 * size);
    return std::clamp(half_px - from_middle + 0.5, 0.0, 1.0);
  };
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = 0; x < WIDTH; ++x) {
      const double expected = covered(x, WIDTH) * covered(y, HEIGHT);
      EXPECT_NEAR(image.pixels[std::size_t{y} * WIDTH + x].r, expected, 0.08) << x << ", " << y;
      partly += expected > 0.1 && expected < 0.9 ? 1 : 0;
    }
  EXPECT_GT(partly, 20U);
}

TEST_F(KnownAnswer, BlendsOverSkyAndOverGeometryFarToNear) {
  Scene scene = wall_scene({.emissive = glm::vec3(4.0F)}, 1.0F);
  scene.sky = glm::vec3(1.0F);
  const auto glass = [&](const glm::vec3& glow, float alpha) {
    scene.materials.push_back(
        {.base_color = glm::vec4(0.0F, 0.0F, 0.0F, alpha), .emissive = glow, .alpha_mode = AlphaMode::blend});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  };
  // The nearer pane comes first in the file; panes behind the wall must not show through it.
  add_wall(scene, {-2.0F, -2.0F, 2.0F, 2.0F, 1.0F}, glass({0.0F, 8.0F, 0.0F}, 0.25F));
  add_wall(scene, {-2.0F, -2.0F, 2.0F, 2.0F, 0.5F}, glass({2.0F, 0.0F, 0.0F}, 0.5F));
  add_wall(scene, {-9.0F, -9.0F, 9.0F, 9.0F, -1.0F}, glass({0.0F, 0.0F, 16.0F}, 0.5F));
  const Pictures pictures(scene);
  for_each_path([&](ShadingPath path) {
    const glm::dvec3 red(2.0, 0.0, 0.0);
    const glm::dvec3 green(0.0, 8.0, 0.0);
    const glm::dvec3 blue(0.0, 0.0, 16.0);
    const auto through = [](const glm::dvec3& pane, double alpha, const glm::dvec3& behind) {
      return pane * alpha + behind * (1.0 - alpha);
    };
    const glm::dvec3 far_pane_over_sky = through(blue, 0.5, glm::dvec3(1.0));
    expect_near(pictures.at(path, {1, 1}), far_pane_over_sky, 1e-6);
    expect_near(pictures.at(path, {32, 24}), through(green, 0.25, through(red, 0.5, glm::dvec3(4.0))), 1e-6);
    expect_near(pictures.at(path, {32, 12}), through(green, 0.25, through(red, 0.5, far_pane_over_sky)), 1e-6);
  });
}

}  // namespace
}  // namespace lamp::app
