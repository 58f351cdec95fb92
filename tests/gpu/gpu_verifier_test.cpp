// The GPU verifier finds what the oracle finds: in every method, and in truths and lists with known faults.
// SPDX-License-Identifier: Apache-2.0
#include "render/gpu_verifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/faulty_lists.h"
#include "gpu/in_turn.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "scene/builtin.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

Findings by_oracle(Renderer& renderer, Lighting& lighting, const LitCase& lit, Passes which) {
  Verification verification(lit.view.width());
  verification.add(lit.truth, renderer.visit(lighting, lit.truth, which));
  return verification.findings();
}

/// Where a look-up walks several lists at a position, pixels with one number for their cell may walk different lights.
/// The oracle counts each list that it met then, and the GPU none.
bool has_one_list(const Lighting& lighting) { return !lighting.info().method->any_point; }

void expect_same(const Findings& gpu, const Findings& oracle, bool one_list = true) {
  EXPECT_EQ(gpu.missed, oracle.missed);
  EXPECT_EQ(gpu.evaluations, oracle.evaluations);
  EXPECT_EQ(gpu.useful, oracle.useful);
  EXPECT_EQ(gpu.boundary_pairs, oracle.boundary_pairs);
  EXPECT_EQ(gpu.unfollowed, oracle.unfollowed);
  EXPECT_EQ(gpu.first_unfollowed, oracle.first_unfollowed);
  if (one_list) {
    EXPECT_EQ(gpu.list_sum, oracle.list_sum);
    EXPECT_EQ(gpu.cells_seen, oracle.cells_seen);
  }
  EXPECT_EQ(gpu.list_max, oracle.list_max);
  EXPECT_EQ(gpu.unordered, oracle.unordered);
  EXPECT_EQ(gpu.first_miss, oracle.first_miss);
  EXPECT_EQ(gpu.repeated, 0);
}

constexpr std::uint32_t LARGEST_COUNT = 600;

struct Param {
  std::string_view scene;
  std::string_view projection;
  std::uint32_t count;
  Mix mix;
  std::size_t number;  ///< methods take turns
};

std::vector<Param> params() {
  constexpr Mix MIXES[] = {Mix::points, Mix::spots, Mix::both};
  constexpr std::uint32_t COUNTS[] = {0, 1, 33, 257, LARGEST_COUNT};
  std::vector<Param> made;
  std::size_t number_of_scene = 0;
  for (const BuiltinScene& scene : builtin_scenes()) {
    // Each method meets every other scene, and each projection.
    std::size_t number = number_of_scene++;
    for (const std::string_view projection : tested_projections())
      made.push_back({scene.name, projection, COUNTS[made.size() % std::size(COUNTS)],
                      MIXES[made.size() % std::size(MIXES)], number++});
  }
  return made;
}

class GpuVerifierMatrix : public GpuTest, public ::testing::WithParamInterface<Param> {};

TEST_P(GpuVerifierMatrix, FindsWhatTheOracleFinds) {
  LAMP_SKIP_WITHOUT_DOUBLES();
  const auto& [name, projection, count, mix, number] = GetParam();
  constexpr std::uint32_t WIDTH = 50;
  constexpr std::uint32_t HEIGHT = 37;
  const TestScene& scene = builtin_test_scene(name);
  const View view = view_of(find_camera(scene.scene, ""), WIDTH, HEIGHT, projection);
  Renderer renderer(test_context(), shader_library(), scene.gpu, WIDTH, HEIGHT, count);
  const LitCase lit =
      make_case(renderer, view, test_lights(scene.air, view, {.count = count, .mix = mix, .seed = count}));
  GpuVerifier verifier(renderer, lit.lights);
  for (std::size_t m = 0; m < methods().size(); ++m) {
    if (!has_turn(m + GetParam().number, 8)) continue;
    const Method& method = methods()[m];
    SCOPED_TRACE(method.name);
    Lighting lighting = make_lighting(renderer, {.method = &method, .light_capacity = LARGEST_COUNT});
    const Findings oracle = by_oracle(renderer, lighting, lit, Passes::separate);
    const Findings gpu = verifier.check(lighting);
    expect_same(gpu, oracle, has_one_list(lighting));
    if (oracle.missed != 0) {
      EXPECT_FALSE(gpu.truth_sum);
    } else if (has_one_list(lighting)) {
      EXPECT_EQ(gpu.truth_sum, oracle.truth_sum);
    }
    if (!lighting.runner().plan().fused) continue;
    SCOPED_TRACE("fused");
    expect_same(verifier.check(lighting, Passes::fused), by_oracle(renderer, lighting, lit, Passes::fused));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GpuVerifierMatrix, ::testing::ValuesIn(params()), [](const auto& test) {
  return test_name(fmt::format("{}__{}", test.param.scene, test.param.projection));
});

class GpuVerifierFaults : public GpuTest {
 protected:
  void SetUp() override { LAMP_SKIP_WITHOUT_DOUBLES(); }

  static constexpr std::uint32_t WIDTH = 24;
  static constexpr std::uint32_t HEIGHT = 20;
  static constexpr std::uint32_t COUNT = 40;

  GpuVerifierFaults()
      : scene_(builtin_test_scene("plane")),
        view_(view_of(scene_.scene.cameras.front(), WIDTH, HEIGHT, "camera")),
        renderer_(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, COUNT),
        lit_(make_case(renderer_, view_, test_lights(scene_.air, view_, {.count = COUNT, .mix = Mix::points}))) {}

  const TestScene& scene_;
  View view_;
  Renderer renderer_;
  LitCase lit_;
};

TEST_F(GpuVerifierFaults, FaultyListsAreFoundOutWithTheRightCounts) {
  const std::uint64_t reached = std::ranges::count(lit_.truth.lights, LEFT_OUT);
  const std::uint64_t next_reached = std::ranges::count(lit_.truth.lights, LEFT_OUT + 1);
  const std::uint64_t all = lit_.truth.lights.size();
  const std::uint64_t pixels = std::ranges::count_if(lit_.depth, [](float depth) { return depth > 0.0F; });
  ASSERT_GT(reached, 0);
  ASSERT_GT(all, reached);
  struct Expectation {
    Method method;
    std::uint64_t missed = 0;
    std::uint64_t repeated = 0;
    bool unordered = false;
    std::uint64_t walked = 0;
  };
  const Expectation expectations[] = {
      {faulty_method<Fault::none>(), 0, 0, false, COUNT},
      {faulty_method<Fault::descending>(), 0, 0, true, COUNT},
      {faulty_method<Fault::duplicate>(), 0, reached, true, COUNT + 1},
      {faulty_method<Fault::one_left_out>(), reached, 0, false, COUNT - 1},
      {faulty_method<Fault::descending_and_one_left_out>(), reached, 0, true, COUNT - 1},
      {faulty_method<Fault::descending_duplicate_and_one_left_out>(), reached, next_reached, true, COUNT},
      {faulty_method<Fault::swap>(), 0, 0, true, COUNT},
  };
  GpuVerifier verifier(renderer_, lit_.lights);
  for (const Expectation& expected : expectations) {
    SCOPED_TRACE(&expected - expectations);
    Lighting lighting = make_lighting(renderer_, {.method = &expected.method, .light_capacity = COUNT});
    const Findings findings = verifier.check(lighting);
    EXPECT_EQ(findings.useful, all);
    EXPECT_EQ(findings.missed, expected.missed);
    EXPECT_EQ(findings.repeated, expected.repeated);
    EXPECT_EQ(findings.unordered, expected.unordered);
    EXPECT_EQ(findings.evaluations, expected.walked * pixels);
    EXPECT_EQ(findings.first_miss, by_oracle(renderer_, lighting, lit_, Passes::separate).first_miss);
  }
}

// What is missing and what is there twice was counted by walking again and again, until a device ended the loops.
TEST_F(GpuVerifierFaults, CountsAreRightHoweverManyLightsAPixelHas) {
  constexpr std::uint32_t MANY = 1000;
  const shared::Light everywhere =
      pack(Light{.position = glm::vec3(0.0F, 1.0F, 0.0F), .range = std::numeric_limits<float>::infinity()});
  Renderer renderer(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, MANY);
  const LitCase lit = make_case(renderer, view_, std::vector<shared::Light>(MANY, everywhere));
  const std::uint64_t pixels = std::ranges::count_if(lit.depth, [](float depth) { return depth > 0.0F; });
  GpuVerifier verifier(renderer, lit.lights);
  const Method method = faulty_method<Fault::descending_duplicate_and_one_left_out>();
  Lighting lighting = make_lighting(renderer, {.method = &method, .light_capacity = MANY});
  const Findings findings = verifier.check(lighting);
  EXPECT_EQ(findings.missed, pixels);
  EXPECT_EQ(findings.repeated, pixels);
  EXPECT_EQ(findings.useful, MANY * pixels);
  EXPECT_EQ(findings.unfollowed, 0);
}

TEST_F(GpuVerifierFaults, AWalkThatTheDeviceEndsIsNotCalledAMiss) {
  if (renderer_.device().traits.max_loop_rounds == ~0U) GTEST_SKIP() << "the device ends no loops";
  const Method method = faulty_method<Fault::endless>();
  Lighting lighting = make_lighting(renderer_, {.method = &method, .light_capacity = COUNT});
  const Findings findings = GpuVerifier(renderer_, lit_.lights).check(lighting);
  EXPECT_GT(findings.unfollowed, 0);
  expect_same(findings, by_oracle(renderer_, lighting, lit_, Passes::separate));
  EXPECT_FALSE(findings.truth_sum);
}

// Ranges, of spots too, and cones whose boundary goes through pixels, and some whose does not.
TEST_F(GpuVerifierFaults, BoundaryPairsAreCountedAsTheOracleDoes) {
  std::vector<shared::Light> lights;
  for (std::uint32_t i = 0; i < COUNT; ++i) {
    const std::uint32_t x = i * 7 % WIDTH;
    const std::uint32_t y = HEIGHT - 1 - i % 5;
    const float depth = lit_.depth[y * WIDTH + x];
    ASSERT_GT(depth, 0.0F);
    const glm::dvec3 at = view_.world_position(x, y, depth);
    const glm::dvec3 away(0.3 * (i % 3) + 0.1, 1.0 + 0.1 * i, 0.2);
    const glm::vec3 position(at + away);
    const double distance = glm::length(at - glm::dvec3(position));
    const bool is_spot = i % 2 == 1;
    const bool by_cone = i % 4 == 1;
    const double steps = i % 8 < 6 ? 0.0 : 3.0 * BOUNDARY_BAND;  // the others are just beyond the band
    const glm::vec3 direction(0.0F, -1.0F, 0.0F);
    const double angle = std::acos(glm::dot(glm::normalize(at - glm::dvec3(position)), glm::dvec3(direction)));
    lights.push_back(
        pack(Light{.type = is_spot ? LightType::spot : LightType::point,
                   .position = position,
                   .range = static_cast<float>(by_cone ? 2.0 * distance : distance * (1.0 + steps)),
                   .direction = direction,
                   .outer_angle = static_cast<float>(by_cone ? angle * (1.0 + steps) : 0.5 * (angle + 1.57))}));
  }
  const LitCase lit = make_case(renderer_, view_, lights);
  Lighting lighting = make_lighting(renderer_, {.method = &brute_force(), .light_capacity = COUNT});
  const Findings oracle = by_oracle(renderer_, lighting, lit, Passes::separate);
  EXPECT_GE(oracle.boundary_pairs, COUNT / 2);
  expect_same(GpuVerifier(renderer_, lit.lights).check(lighting), oracle);
}

TEST_F(GpuVerifierFaults, RowsAreThoseAskedFor) {
  const Truth band = truth({.view = view_, .depth = lit_.depth, .lights = lit_.lights, .first_row = 11, .rows = 6});
  GpuVerifier verifier(renderer_, lit_.lights, {11, 6});
  for (const char* name : {"tiled", "clustered", "all"}) {
    SCOPED_TRACE(name);
    Lighting lighting = make_lighting(renderer_, {.method = take(find_method(name)), .light_capacity = COUNT});
    Verification verification(WIDTH);
    verification.add(band, renderer_.visit(lighting, band));
    const Findings oracle = verification.findings();
    const Findings gpu = verifier.check(lighting);
    expect_same(gpu, oracle);
    EXPECT_EQ(gpu.truth_sum, oracle.truth_sum);
  }
}

}  // namespace
}  // namespace lamp::app
