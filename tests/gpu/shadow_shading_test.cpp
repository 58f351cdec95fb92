// Pictures with shadows: through every method brute force's, on every path; darker than without, and where rays say so.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/in_turn.h"
#include "gpu/test_scenes.h"
#include "render/judgement.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 54;
constexpr std::uint32_t COUNT = 60;

struct Frame {
  Frame(const TestScene& of, std::string_view projection) : scene(of) {
    view = view_of(scene.scene.cameras.front(), WIDTH, HEIGHT, projection);
    lights = pack(place_lights(scene.air, {.count = COUNT, .spots = 0.5F, .min_range = 2.0F, .max_range = 8.0F}));
  }
  [[nodiscard]] Renderer renderer(std::optional<ShadowFilter> filter) const {
    Renderer made(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, COUNT);
    if (filter) made.cast_shadows({.filter = *filter, .atlas_size = 1024});
    made.set_frame(view, lights);
    return made;
  }
  [[nodiscard]] Lighting lighting(std::string_view method, ShadingPath path, std::optional<ShadowFilter> filter) const {
    LightingInfo info{.method = take(find_method(method)),
                      .width = WIDTH,
                      .height = HEIGHT,
                      .light_capacity = COUNT,
                      .path = path,
                      .transparency = !scene.gpu.blended().empty(),
                      .shadows = filter};
    info.options = take(resolve_options(*info.method, {}));
    return {test_context().device(), shader_library(), info};
  }

  const TestScene& scene;
  View view;
  std::vector<shared::Light> lights;
};

double brightness(const HdrImage& image) {
  double sum = 0.0;
  for (const glm::vec4& pixel : image.pixels) sum += double{pixel.x} + double{pixel.y} + double{pixel.z};
  return sum;
}

class ShadowShading : public GpuTest, public ::testing::WithParamInterface<ShadingPath> {};

TEST_P(ShadowShading, IsTheSameThroughEveryMethod) {
  const Frame frame(builtin_test_scene("atrium"), "perspective");
  Renderer renderer = frame.renderer(ShadowFilter::pcf);
  Lighting brute = frame.lighting("all", GetParam(), ShadowFilter::pcf);
  const HdrImage reference = renderer.render(brute).image;
  EXPECT_GT(renderer.shadows()->counts().shadowed, 20U);
  EXPECT_EQ(renderer.shadows()->counts().without, 0U);
  Renderer without = frame.renderer(std::nullopt);
  Lighting lit = frame.lighting("all", GetParam(), std::nullopt);
  const HdrImage unshadowed = without.render(lit).image;
  EXPECT_LT(brightness(reference), brightness(unshadowed));
  for (std::size_t i = 0; i < reference.pixels.size(); ++i)
    ASSERT_TRUE(glm::all(glm::lessThanEqual(reference.pixels[i], unshadowed.pixels[i] * 1.0001F))) << i;
  // In compute every method, by one path or the other; in fragments, where a look-up of each kind is enough, a few.
  const bool few = GetParam() == ShadingPath::forward || GetParam() == ShadingPath::standard_deferred;
  std::size_t number = GetParam() == ShadingPath::deferred ? 0 : 1;
  for (const Method& method : methods()) {
    if (few && method.name != "tight" && method.name != "tiled-bits" && method.name != "lamplight") continue;
    if (!few && !has_turn(number++, 2)) continue;
    if (method.approximate) continue;
    Lighting lighting = frame.lighting(method.name, GetParam(), ShadowFilter::pcf);
    EXPECT_LE(max_abs_difference(renderer.relight(lighting).image, reference),
              picture_tolerance(lighting.runner().plan(), reference))
        << method.name;
  }
}

TEST_F(GpuTest, PicturesWithMomentsAreTheSameThroughEveryMethod) {
  const Frame frame(builtin_test_scene("corridor"), "off-centre");
  for (const ShadowFilter filter : {ShadowFilter::vsm, ShadowFilter::evsm}) {
    Renderer renderer = frame.renderer(filter);
    Lighting brute = frame.lighting("all", ShadingPath::deferred, filter);
    const HdrImage reference = renderer.render(brute).image;
    EXPECT_GT(renderer.shadows()->counts().shadowed, 5U);
    for (const char* method : {"tight", "clustered", "lamplight"}) {
      Lighting lighting = frame.lighting(method, ShadingPath::deferred, filter);
      EXPECT_EQ(max_abs_difference(renderer.relight(lighting).image, reference), 0.0F) << method;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(On, ShadowShading,
                         ::testing::Values(ShadingPath::forward, ShadingPath::tiled_deferred, ShadingPath::deferred,
                                           ShadingPath::standard_deferred),
                         [](const auto& test) {
                           return test_name(path_names()[static_cast<std::size_t>(test.param)]);
                         });

}  // namespace
}  // namespace lamp::app
