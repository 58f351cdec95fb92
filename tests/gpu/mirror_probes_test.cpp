// Mirrored light together with reflection probes: each surface's reflection is shared between its ray and its probes,
// and nothing of it is there twice or missing.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "gpu/hall.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/box_shapes.h"
#include "render/pixel_lights.h"
#include "render/place_probes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 64;
constexpr std::uint32_t HEIGHT = 40;
constexpr std::uint32_t LIGHTS = 40;
constexpr std::array PATHS{ShadingPath::deferred, ShadingPath::tiled_deferred, ShadingPath::forward,
                           ShadingPath::standard_deferred};

/// A picture and what reflects in it.
struct Shown {
  const GpuScene& gpu;
  View view;
  std::vector<shared::Light> lights;
  std::vector<gpu::ProbeData> probes;
  float limit = 0.0F;  ///< of roughness, for mirrors; 0: none
  MirrorLists lists = MirrorLists::world_cells;
  ShadingPath path = ShadingPath::deferred;
  const Method* method = &brute_force();
};

/// A renderer that shows it, and what lights it.
class Stage {
 public:
  explicit Stage(const Shown& shown)
      : captures_(test_context(), shader_library(), 0),
        set_(test_context(), captures_, shown.probes.empty() ? gpu::PROBES_OFF : gpu::PROBES_FLAT, shown.probes),
        renderer_(test_context(), shader_library(), shown.gpu, WIDTH, HEIGHT,
                  static_cast<std::uint32_t>(shown.lights.size())) {
    renderer_.light_probes(&set_);
    if (shown.limit > 0.0F) renderer_.mirror({.roughness = shown.limit, .lists = shown.lists});
    renderer_.set_frame(shown.view, shown.lights);
    lighting_.emplace(renderer_.device(), shader_library(),
                      LightingInfo{.method = shown.method,
                                   .options = take(resolve_options(
                                       *shown.method, with_box_shapes(*shown.method, {}, !shown.probes.empty()))),
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .light_capacity = renderer_.data().entities().boxes.end,
                                   .path = shown.path,
                                   .transparency = !shown.gpu.blended().empty(),
                                   .probes = set_.kind(),
                                   .mirror = renderer_.mirror_roughness()});
  }

  [[nodiscard]] HdrImage picture() { return renderer_.render(*lighting_).image; }
  [[nodiscard]] Renderer& renderer() { return renderer_; }
  [[nodiscard]] Lighting& lighting() { return *lighting_; }

 private:
  ProbeAtlas captures_;
  ProbeSet set_;
  Renderer renderer_;
  std::optional<Lighting> lighting_;
};

HdrImage picture(const Shown& shown) { return Stage(shown).picture(); }

/// a A + b B + c C ...
HdrImage sum_of(std::span<const std::pair<float, const HdrImage*>> terms) {
  HdrImage sum = *terms.front().second;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
    sum.pixels[i] = glm::vec4(0.0F);
    for (const auto& [factor, image] : terms) sum.pixels[i] += factor * image->pixels[i];
  }
  return sum;
}

/// As G-buffers keep it.
float stored(float roughness) { return std::round(roughness * 255.0F) / 255.0F; }
/// As docs/methods/mirror.md has it: all up to half the limit, then less.
float weight_of(float roughness, float limit) { return std::clamp(2.0F - 2.0F * roughness / limit, 0.0F, 1.0F); }

constexpr float FLOOR_ROUGHNESS = 0.05F;

/// One probe that gives the hall's floor 60 % of its reflection; the ambient light has the rest.
class MirrorAndProbes : public GpuTest {
 protected:
  static Scene lit_hall() {
    Scene scene = hall(50.0F);
    scene.ambient = {0.3F, 0.5F, 0.7F};
    return scene;
  }
  static std::vector<gpu::ProbeData> probe_of_hall() {
    std::vector<gpu::ProbeData> probes = pack({Probe{.center = {0.0F, 9.4F, 0.0F},
                                                     .half_extents = {40.0F, 10.0F, 40.0F},
                                                     .blend_m = 1.0F,
                                                     .parallax_center = {0.0F, 9.4F, 0.0F},
                                                     .parallax_half_extents = {40.0F, 10.0F, 40.0F}}});
    probes.front().flat_radiance = {3.0F, 0.5F, 1.0F};
    return probes;
  }
  static Shown of_hall(const TestScene& scene) {
    return {.gpu = scene.gpu,
            .view = view_of(scene.scene.cameras[0], WIDTH, HEIGHT, "camera"),
            .lights = {},
            .probes = probe_of_hall()};
  }
  static Shown with(Shown shown, float limit, bool probes) {
    shown.limit = limit;
    if (!probes) shown.probes.clear();
    return shown;
  }
};

/// From no ray over part of one to nothing but the ray; at either end to the bit.
TEST_F(MirrorAndProbes, ShareTheReflectionByTheRaysWeight) {
  const TestScene scene(lit_hall());
  Shown shown = of_hall(scene);
  for (const ShadingPath path : PATHS) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    shown.path = path;
    const HdrImage of_probes = picture(with(shown, 0.0F, true));
    const HdrImage of_rays = picture(with(shown, 1.0F, false));
    ASSERT_GT(max_abs_difference(of_probes, picture(with(shown, 0.0F, false))), 0.5F);
    ASSERT_GT(max_abs_difference(of_probes, of_rays), 0.5F);
    for (const float limit : {0.02F, 0.05F, 0.0511F, 0.055F, 0.06F, 0.08F, 0.1F, 0.11F, 1.0F}) {
      SCOPED_TRACE(limit);
      const float weight = weight_of(stored(FLOOR_ROUGHNESS), limit);
      const std::pair<float, const HdrImage*> expected[] = {{1.0F - weight, &of_probes}, {weight, &of_rays}};
      const float exact = weight == 0.0F || weight == 1.0F ? 0.0F : 1e-5F;
      EXPECT_LE(max_abs_difference(picture(with(shown, limit, true)), sum_of(expected)), exact);
    }
  }
}

/// Rays begin at no blended surface: it has its probes, whatever the floor behind it has.
TEST_F(MirrorAndProbes, LeaveBlendedSurfacesTheirProbes) {
  const auto shown_behind = [](float alpha) {
    Scene scene = lit_hall();
    scene.materials.push_back(scene.materials[0]);
    scene.materials.back().alpha_mode = AlphaMode::blend;
    scene.materials.back().base_color.a = alpha;
    add_quad(scene, 0.4F, 20.0F, true, 2);
    return scene;
  };
  constexpr float ALPHA = 0.5F;
  const TestScene open(lit_hall());
  const TestScene paned(shown_behind(ALPHA));
  const auto by_probes = [&](const TestScene& scene, float limit) {
    const HdrImage there = picture(with(of_hall(scene), limit, true));
    const HdrImage gone = picture(with(of_hall(scene), limit, false));
    const std::pair<float, const HdrImage*> terms[] = {{1.0F, &there}, {-1.0F, &gone}};
    return sum_of(terms);
  };
  const HdrImage behind = by_probes(open, 0.0F);
  const HdrImage both = by_probes(paned, 0.0F);
  const std::pair<float, const HdrImage*> expected[] = {{1.0F, &both}, {ALPHA - 1.0F, &behind}};
  const HdrImage mirrored = by_probes(paned, 1.0F);
  EXPECT_GT(largest_value(mirrored), 0.2F);
  EXPECT_LE(max_abs_difference(mirrored, sum_of(expected)), 1e-5F);
}

/// As the inspector shows it.
TEST_F(MirrorAndProbes, SayWhatTheRayLeavesOfAPixel) {
  const TestScene scene(lit_hall());
  constexpr std::uint32_t PIXEL = WIDTH * HEIGHT / 2 + WIDTH / 2;
  const auto terms = [&](float limit) {
    Stage stage(with(of_hall(scene), limit, true));
    static_cast<void>(stage.picture());
    const std::vector<std::uint32_t> probes = probes_at(stage.renderer(), stage.lighting(), PIXEL);
    EXPECT_EQ(probes.size(), 1U);
    return terms_at(stage.renderer(), shader_library(), scene.gpu, stage.lighting().info(), PIXEL,
                    {.lights = {}, .probes = probes});
  };
  const PixelTerms none = terms(0.0F);
  const PixelTerms part = terms(0.08F);
  const PixelTerms all = terms(1.0F);
  const float left = 1.0F - weight_of(stored(FLOOR_ROUGHNESS), 0.08F);
  EXPECT_EQ(none.left_by_mirror, 1.0F);
  EXPECT_NEAR(part.left_by_mirror, left, 1e-6F);
  EXPECT_EQ(all.left_by_mirror, 0.0F);
  EXPECT_LT(glm::length(glm::mix(all.surroundings, none.surroundings, left) - part.surroundings), 1e-5F);
}

class MirrorAndProbesInCorridor : public MirrorAndProbes {
 protected:
  static constexpr float LIMIT = 0.9F;

  Shown corridor() const {
    const View view = view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera");
    return {.gpu = scene_.gpu,
            .view = view,
            .lights = test_lights(scene_.air, view, {.count = LIGHTS, .mix = Mix::both}),
            .probes = pack(place_probes(scene_.scene, 30, 3)),
            .limit = LIMIT};
  }

  const TestScene& scene_ = builtin_test_scene("corridor");
};

TEST_F(MirrorAndProbesInCorridor, GiveOnePictureWhateverFindsLightsAndProbes) {
  Shown shown = corridor();
  for (const ShadingPath path : PATHS) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    shown.path = path;
    shown.lists = MirrorLists::brute_force;
    shown.method = &brute_force();
    const HdrImage reference = picture(shown);
    shown.lists = MirrorLists::world_cells;
    EXPECT_EQ(max_abs_difference(picture(shown), reference), 0.0F);
    for (const char* name : {"tight", "drobot-tiled", "lamplight"}) {
      SCOPED_TRACE(name);
      shown.method = take(find_method(name));
      Stage stage(shown);
      EXPECT_LE(max_abs_difference(stage.picture(), reference),
                picture_tolerance(stage.lighting().runner().plan(), reference));
    }
  }
}

/// Of a scene with textures.
TEST_F(MirrorAndProbesInCorridor, LeaveEachOtherTheirSurfaces) {
  const Shown shown = corridor();
  Stage stage(shown);
  const HdrImage both = stage.picture();
  const HdrImage of_rays = picture(with(shown, LIMIT, false));
  const HdrImage of_probes = picture(with(shown, 0.0F, true));
  const HdrImage neither = picture(with(shown, 0.0F, false));
  const CapturedFrame surfaces = stage.renderer().capture();
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < both.pixels.size(); ++i) {
    if (surfaces.depth[i] == 0.0F) continue;
    const float weight = weight_of(surfaces.material[i].y, LIMIT);
    glm::vec4 expected = of_rays.pixels[i] + (1.0F - weight) * (of_probes.pixels[i] - neither.pixels[i]);
    if (weight == 0.0F) expected = of_probes.pixels[i];
    const bool to_the_bit = weight == 0.0F || weight == 1.0F;
    EXPECT_LE(glm::length(both.pixels[i] - expected), to_the_bit ? 0.0F : 1e-4F * (1.0F + glm::length(expected))) << i;
    ++counts[weight == 0.0F ? 0 : weight == 1.0F ? 1 : 2];
  }
  EXPECT_GT(counts[0], 100U);
  EXPECT_GT(counts[1], 10U);
  EXPECT_GT(counts[2], 10U);
  EXPECT_GT(max_abs_difference(both, of_rays), 0.01F);
  EXPECT_GT(max_abs_difference(both, of_probes), 0.01F);
}

}  // namespace
}  // namespace lamp::app
