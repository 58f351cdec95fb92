// Heat maps of shadows, against the oracle's lights of each pixel.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "gpu/test_scenes.h"
#include "oracle/reference.h"
#include "render/shadow_heat.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 54;
constexpr std::uint32_t COUNT = 60;

class ShadowHeatMap : public GpuTest {
 protected:
  ShadowHeatMap() {
    LightingInfo info{.method = take(find_method("lamplight")),
                      .width = WIDTH,
                      .height = HEIGHT,
                      .light_capacity = COUNT,
                      .transparency = !scene_.gpu.blended().empty(),
                      .shadows = ShadowFilter::hard};
    info.options = take(resolve_options(*info.method, {}));
    lighting_.emplace(test_context().device(), shader_library(), info);
    renderer_.cast_shadows({.filter = ShadowFilter::hard, .atlas_size = 512, .budget_texels = 60'000});
  }

  void draw(std::span<const shared::Light> lights) {
    renderer_.set_frame(view_, lights);
    static_cast<void>(renderer_.render(*lighting_));
  }

  /// What a light comes to, by the atlas's own counts.
  [[nodiscard]] std::uint32_t word_of(std::uint32_t light, ShadowHeat of) const {
    const Shadows& shadows = *renderer_.shadows();
    if (std::ranges::binary_search(shadows.without(), light)) return gpu::WITHOUT_SHADOW;
    if (std::ranges::binary_search(shadows.waiting(), light)) return gpu::WAITS_FOR_REDRAWING;
    const shared::ShadowMap& map = shadows.maps()[light];
    if (map.kind == shared::SHADOW_NONE) return 0;
    return of == ShadowHeat::size ? map.side : shadows.ages()[light];
  }

  [[nodiscard]] std::uint32_t expected(std::span<const std::uint32_t> lights, ShadowHeat of) const {
    std::uint32_t worst = 0;
    std::uint32_t smallest = ~0U;
    for (const std::uint32_t light : lights) {
      const std::uint32_t word = word_of(light, of);
      worst = std::max(worst, word);
      if (word != 0) smallest = std::min(smallest, word);
    }
    return of == ShadowHeat::age || worst == 0 || worst >= gpu::WAITS_FOR_REDRAWING ? worst : smallest;
  }

  void compare(std::span<const shared::Light> lights, ShadowHeat of) {
    const std::vector<float> depth = renderer_.read_depth();
    const Truth truth = lamp::truth({.view = view_, .depth = depth, .lights = lights, .rows = HEIGHT});
    const std::vector<std::uint32_t> found = shadow_heat(renderer_, *lighting_, of);
    ASSERT_EQ(found.size(), depth.size());
    std::size_t others = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto reaching = std::span(truth.lights).subspan(truth.offsets[i], truth.offsets[i + 1] - truth.offsets[i]);
      const std::uint32_t right = depth[i] == 0.0F ? gpu::SKY_CELL : expected(reaching, of);
      others += found[i] == right ? 0 : 1;
      seen_.push_back(found[i]);
    }
    EXPECT_LE(others, truth.boundary_pairs);
  }

  [[nodiscard]] bool has_seen(std::uint32_t word) const { return std::ranges::find(seen_, word) != seen_.end(); }

  const TestScene& scene_ = builtin_test_scene("atrium");
  View view_ = view_of(scene_.scene.cameras.front(), WIDTH, HEIGHT, "perspective");
  std::vector<shared::Light> lights_ =
      pack(place_lights(scene_.air, {.count = COUNT, .spots = 0.5F, .min_range = 3.0F, .max_range = 10.0F}));
  Renderer renderer_{test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT};
  std::optional<Lighting> lighting_;
  std::vector<std::uint32_t> seen_;
};

TEST_F(ShadowHeatMap, ShowsTheWorstMapOfTheLightsThatReachAPixel) {
  draw(lights_);
  compare(lights_, ShadowHeat::age);
  EXPECT_TRUE(has_seen(gpu::WITHOUT_SHADOW));
  for (int frame = 0; frame < 12; ++frame) draw(lights_);
  seen_.clear();
  compare(lights_, ShadowHeat::age);
  EXPECT_TRUE(std::ranges::any_of(seen_, [](std::uint32_t age) { return age > 0 && age < 13; }));
  compare(lights_, ShadowHeat::size);
  for (shared::Light& light : lights_) light.position.y += 0.01F;
  draw(lights_);
  seen_.clear();
  compare(lights_, ShadowHeat::size);
  EXPECT_TRUE(has_seen(gpu::WAITS_FOR_REDRAWING));
  EXPECT_TRUE(std::ranges::any_of(seen_, [](std::uint32_t side) { return side >= 16 && side <= 512; }));
  draw({});
  seen_.clear();
  compare({}, ShadowHeat::size);
  EXPECT_TRUE(std::ranges::all_of(seen_, [](std::uint32_t word) { return word == 0 || word == gpu::SKY_CELL; }));
}

}  // namespace
}  // namespace lamp::app
