// The checks themselves can fail: truths and lists with known faults are found out.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "gpu/faulty_lists.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 24;
constexpr std::uint32_t HEIGHT = 20;
constexpr std::uint32_t COUNT = 40;
constexpr std::uint32_t NO_RANGE = 20;  ///< a light that reaches nothing, in the middle

/// A truth with one more light at a pixel.
Truth with_light(const Truth& truth, std::uint32_t pixel, std::uint32_t light) {
  Truth more = truth;
  const auto begin = more.lights.begin() + more.offsets[pixel];
  const auto end = more.lights.begin() + more.offsets[pixel + 1];
  more.lights.insert(std::upper_bound(begin, end, light), light);
  for (std::size_t i = pixel + 1; i < more.offsets.size(); ++i) ++more.offsets[i];
  return more;
}

class CheckTheCheck : public GpuTest {
 protected:
  CheckTheCheck()
      : scene_(builtin_test_scene("plane")),
        view_(view_of(scene_.scene.cameras.front(), WIDTH, HEIGHT, "camera")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT),
        lit_(make_case(renderer_, view_, lights())) {}

  std::vector<shared::Light> lights() const {
    std::vector<shared::Light> made = test_lights(scene_.air, view_, {.count = COUNT, .mix = Mix::points});
    made[NO_RANGE].range = 0.0F;
    return made;
  }

  Findings find(Lighting& lighting, const Truth& truth) {
    Verification verification(WIDTH);
    verification.add(truth, renderer_.visit(lighting, truth));
    return verification.findings();
  }

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
  LitCase lit_;
};

TEST_F(CheckTheCheck, LightThatNoListHoldsIsMissed) {
  const std::uint32_t pixel = (HEIGHT - 3) * WIDTH + 5;
  ASSERT_GT(lit_.depth[pixel], 0.0F);
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    Lighting lighting = make_lighting(renderer_, {.method = &method, .light_capacity = COUNT});
    if (lighting.runner().plan().approximate) continue;
    EXPECT_EQ(find(lighting, lit_.truth).missed, 0);
    const Findings beyond_the_last = find(lighting, with_light(lit_.truth, pixel, COUNT));
    EXPECT_EQ(beyond_the_last.missed, 1);
    EXPECT_EQ(beyond_the_last.first_miss, fmt::format("pixel (5, {}): light {}", HEIGHT - 3, COUNT));
    if (&method == &brute_force()) continue;  // its list holds every light
    const Findings in_between = find(lighting, with_light(lit_.truth, pixel, NO_RANGE));
    EXPECT_EQ(in_between.missed, 1);
    EXPECT_EQ(in_between.first_miss, fmt::format("pixel (5, {}): light {}", HEIGHT - 3, NO_RANGE));
  }
}

TEST_F(CheckTheCheck, MissInALaterBandNamesItsRow) {
  const Truth band = truth({.view = view_, .depth = lit_.depth, .lights = lit_.lights, .first_row = 15, .rows = 5});
  Lighting lighting = make_lighting(renderer_, {.method = &brute_force(), .light_capacity = COUNT});
  const Findings findings = find(lighting, with_light(band, 2 * WIDTH + 7, COUNT));
  EXPECT_EQ(findings.missed, 1);
  EXPECT_EQ(findings.first_miss, fmt::format("pixel (7, 17): light {}", COUNT));
}

TEST_F(CheckTheCheck, FaultyListsAreFoundOut) {
  std::uint64_t reached = 0;
  for (const std::uint32_t light : lit_.truth.lights) reached += light == LEFT_OUT ? 1 : 0;
  ASSERT_GT(reached, 0);
  const std::uint64_t pixels = std::ranges::count_if(lit_.depth, [](float depth) { return depth > 0.0F; });
  struct Expectation {
    Method method;
    std::uint64_t missed = 0;
    bool unordered = false;
    std::uint64_t walked = 0;
  };
  const Expectation expectations[] = {
      {faulty_method<Fault::none>(), 0, false, COUNT},
      {faulty_method<Fault::descending>(), 0, true, COUNT},
      {faulty_method<Fault::duplicate>(), 0, true, COUNT + 1},
      {faulty_method<Fault::one_left_out>(), reached, false, COUNT - 1},
      {faulty_method<Fault::descending_and_one_left_out>(), reached, true, COUNT - 1},
  };
  for (const Expectation& expected : expectations) {
    SCOPED_TRACE(&expected - expectations);
    Lighting lighting = make_lighting(renderer_, {.method = &expected.method, .light_capacity = COUNT});
    const Findings findings = find(lighting, lit_.truth);
    EXPECT_EQ(findings.missed, expected.missed);
    EXPECT_EQ(findings.unordered, expected.unordered);
    EXPECT_EQ(findings.evaluations, expected.walked * pixels);
    EXPECT_EQ(findings.first_miss.empty(), expected.missed == 0);
    const float difference = max_abs_difference(renderer_.render(lighting).image, lit_.reference);
    const bool same_sum = expected.missed == 0 && !expected.unordered;
    EXPECT_EQ(difference == 0.0F, same_sum) << difference;
  }
}

/// A picture with more lights that reach every pixel than walks and searches together find rounds for on a device that
/// ends loops, or than one buffer holds.
struct Crowd {
  Crowd(std::uint32_t width, std::uint32_t height, std::uint32_t count)
      : scene(builtin_test_scene("plane")),
        renderer(test_context(), shader_library(), scene.gpu, width, height, count),
        lit(make_case(renderer, view_of(scene.scene.cameras.front(), width, height, "camera"),
                      std::vector<shared::Light>(count, everywhere()))) {}

  static shared::Light everywhere() {
    return pack(Light{.position = glm::vec3(0.0F, 1.0F, 0.0F), .range = std::numeric_limits<float>::infinity()});
  }

  Findings find(const Method& method) {
    Lighting lighting =
        make_lighting(renderer, {.method = &method, .light_capacity = static_cast<std::uint32_t>(lit.lights.size())});
    Verification verification(lit.view.width());
    verification.add(lit.truth, renderer.visit(lighting, lit.truth));
    return verification.findings();
  }

  const TestScene& scene;
  Renderer renderer;
  LitCase lit;
};

class CrowdedCheck : public GpuTest {};

// Searching a list for 32 of its lights at a time took more than llvmpipe's 65 535 rounds from 577 lights on.
TEST_F(CrowdedCheck, ManyLightsInAnyOrderAreSearchedToTheEnd) {
  Crowd crowd(24, 20, 1000);
  const std::uint64_t pixels = std::ranges::count_if(crowd.lit.depth, [](float depth) { return depth > 0.0F; });
  ASSERT_EQ(crowd.lit.truth.lights.size(), 1000 * pixels);
  const Findings descending = crowd.find(faulty_method<Fault::descending>());
  EXPECT_EQ(descending.missed, 0) << descending.first_miss;
  EXPECT_EQ(descending.unfollowed, 0);
  EXPECT_TRUE(descending.unordered);
  const Findings one_left_out = crowd.find(faulty_method<Fault::descending_and_one_left_out>());
  EXPECT_EQ(one_left_out.missed, pixels);
  EXPECT_TRUE(one_left_out.first_miss.ends_with(fmt::format(": light {}", LEFT_OUT))) << one_left_out.first_miss;
}

// 36 million pairs are more than a storage buffer of 128 MiB holds, the most that many devices have.
TEST_F(CrowdedCheck, ATruthMayBeLargerThanABuffer) {
  Crowd crowd(32, 24, 60'000);
  ASSERT_GT(crowd.lit.truth.lights.size(), (128U << 20) / sizeof(std::uint32_t));
  const Findings all = crowd.find(brute_force());
  EXPECT_EQ(all.missed, 0) << all.first_miss;
  EXPECT_EQ(all.evaluations, crowd.lit.truth.lights.size());
  EXPECT_EQ(all.unfollowed, 0);
}

TEST_F(CheckTheCheck, AWalkThatTheDeviceEndsIsNotCalledAMiss) {
  if (renderer_.device().traits.max_loop_rounds == ~0U) GTEST_SKIP() << "the device ends no loops";
  const std::uint64_t pixels = std::ranges::count_if(lit_.depth, [](float depth) { return depth > 0.0F; });
  const Method method = faulty_method<Fault::endless>();
  Lighting lighting = make_lighting(renderer_, {.method = &method, .light_capacity = COUNT});
  const Findings findings = find(lighting, lit_.truth);
  EXPECT_EQ(findings.unfollowed, pixels);
  EXPECT_FALSE(findings.first_unfollowed.empty());
  EXPECT_EQ(findings.missed, 0);
  EXPECT_EQ(findings.evaluations, 0);
  EXPECT_FALSE(findings.excess());
  EXPECT_EQ(judge(lighting.runner().plan(), findings, std::nullopt).verdict, Verdict::unchecked);
}

TEST(Difference, OneChangedBitCounts) {
  const HdrImage image{.width = 3, .height = 1, .pixels = {glm::vec4(0.25F), glm::vec4(1e-30F), glm::vec4(65536.0F)}};
  EXPECT_EQ(max_abs_difference(image, image), 0.0F);
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel) {
    for (int channel = 0; channel < 4; ++channel) {
      HdrImage changed = image;
      float& value = changed.pixels[pixel][channel];
      value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1U);
      EXPECT_GT(max_abs_difference(image, changed), 0.0F);
    }
  }
  HdrImage broken = image;
  broken.pixels[1].g = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(max_abs_difference(image, broken), std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace lamp::app
