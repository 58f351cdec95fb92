// Every value of every option of every method, one at a time against the row's own values, and random combinations:
// nothing missed, same picture through each kind of look-up. Refused combinations must say which option and why.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "lamplight/shared/lamplight.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 77;
constexpr std::uint32_t HEIGHT = 45;
constexpr std::uint32_t LIGHTS = 150;

class Axes : public GpuTest {
 protected:
  Axes()
      : scene_(builtin_test_scene("posts")),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "infinite")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS + 64),
        lit_(make_case(renderer_, view_, test_lights(scene_.air, view_, {.count = LIGHTS}))) {}

  /// Checks the combination; false if the library refuses it.
  bool check(const Method& method, const std::vector<std::string>& settings) { return check(method, settings, lit_); }

  bool check(const Method& method, const std::vector<std::string>& settings, const LitCase& lit) {
    SCOPED_TRACE(fmt::format("{} {}", method.name, fmt::join(settings, " ")));
    const Result<Options> options = resolve_options(method, settings);
    EXPECT_TRUE(options.ok());
    const auto capacity = static_cast<std::uint32_t>(lit.lights.size());
    const Result<Plan> plan = make_plan(method, {.width = WIDTH,
                                                 .height = HEIGHT,
                                                 .light_capacity = capacity,
                                                 .options = options.value(),
                                                 .traits = renderer_.device().traits});
    if (!plan) {
      EXPECT_NE(plan.error().text().find("option"), std::string::npos) << plan.error().text();
      return false;
    }
    check_method(renderer_, lit, {.method = &method, .settings = settings, .light_capacity = capacity},
                 is_new(plan.value()) ? Check::separate_and_fused : Check::lists);
    return true;
  }

  /// Whether shading has not walked such look-ups yet. Those that differ in numbers alone, such as the size of a tile,
  /// are walked for their lists: a picture of each would take a software device a second's compilation.
  bool is_new(const Plan& plan) {
    return pictured_.insert(plan.lookup.name + (plan.fused ? plan.fused->lookup.name : "")).second;
  }

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
  LitCase lit_;
  std::set<std::string> pictured_;
};

TEST_F(Axes, EveryValueOfEveryOption) {
  for (const Method& method : methods()) {
    const auto is = [&](std::string_view name) { return method.name == name; };
    if (std::ranges::none_of(std::array{"tiled", "tiled-bits", "clustered", "tight", "drobot-zbin", "lamplight",
                                        "drobot-raster-tile", "drobot-raster-cluster"},
                             is))
      continue;  // the other rows differ from these in their options only; the matrix covers them as they are
    for (const OptionSpec& spec : method.options)
      for (const std::string& value : sample_values(spec)) check(method, {fmt::format("{}={}", spec.key, value)});
  }
}

TEST_F(Axes, RandomCombinations) {
  std::mt19937 random(7);
  for (const char* name : {"tiled", "lamplight"}) {
    const Method& method = *take(find_method(name));
    std::uint32_t accepted = 0;
    for (int round = 0; round < 500 && accepted < 5; ++round) {
      std::vector<std::string> settings;
      for (const OptionSpec& spec : method.options) {
        const std::vector<std::string> values = sample_values(spec);
        settings.push_back(fmt::format("{}={}", spec.key, values[random() % values.size()]));
      }
      accepted += check(method, settings) ? 1 : 0;
    }
    EXPECT_EQ(accepted, 5U) << name;
  }
}

// Slices and containers together, as every value by itself does not show.
TEST_F(Axes, LamplightWithoutDepthBuffer) {
  const Method& method = *take(find_method("lamplight"));
  for (const char* container : {"list", "bits"})
    for (const char* tile : {"8", "32"})
      for (const char* scale : {"log", "linear"})
        for (const char* cells : {"list", "bits"})
          EXPECT_TRUE(check(method, {"depth=none", fmt::format("container={}", container), fmt::format("tile={}", tile),
                                     fmt::format("scale={}", scale), fmt::format("cells={}", cells), "slices=7"}));
}

// Cells that look at every light themselves, which the other tests have too many lights for.
TEST_F(Axes, LamplightOfFewLights) {
  const Method& method = *take(find_method("lamplight"));
  const LitCase few = make_case(renderer_, view_, test_lights(scene_.air, view_, {.count = shared::PIECE}));
  for (const char* container : {"list", "bits"})
    for (const char* tile : {"8", "32"})
      for (const char* prune : {"none", "pixel"})
        EXPECT_TRUE(check(method,
                          {"cells=gather", fmt::format("container={}", container), fmt::format("tile={}", tile),
                           fmt::format("prune={}", prune)},
                          few));
}

TEST_F(Axes, WithoutDepthBoundsWhateverNeedsNone) {
  const Method& tiled = *take(find_method("tiled"));
  std::uint32_t accepted = 0;
  for (const char* test : {"planes", "aabb", "planes+aabb", "cone-approximate", "cone", "exact"})
    for (const char* spot : {"sphere", "cone-planes", "cone-sphere"})
      for (const char* prune : {"none", "pixel"})
        accepted += check(tiled, {"bounds=none", fmt::format("test={}", test), fmt::format("spot={}", spot),
                                  fmt::format("prune={}", prune)})
                        ? 1
                        : 0;
  EXPECT_EQ(accepted, 3U * 2U * 2U);  // planes and both cones; spheres of spots and their cones against planes
}

TEST_F(Axes, KeptFrustaAreMadeAnewOnlyWhenTheProjectionChanges) {
  const Method& method = *take(find_method("article-deferred"));
  Lighting lighting =
      make_lighting(renderer_, {.method = &method, .light_capacity = static_cast<std::uint32_t>(lit_.lights.size())});
  for (int frame = 0; frame < 3; ++frame) {
    renderer_.set_frame(view_, lit_.lights);
    static_cast<void>(renderer_.render(lighting));
  }
  EXPECT_EQ(lighting.runner().projection_rebuilds(), 1U);
  const View other = view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "orthographic");
  renderer_.set_frame(other, lit_.lights);
  static_cast<void>(renderer_.render(lighting));
  EXPECT_EQ(lighting.runner().projection_rebuilds(), 2U);
}

}  // namespace
}  // namespace lamp::app
