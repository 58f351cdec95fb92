// `auto`: the estimate of a workload against the oracle, the fit against known costs, the choice against its rules.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/choose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "oracle/reference.h"

namespace lamp {
namespace {

constexpr std::uint32_t WIDTH = 192;
constexpr std::uint32_t HEIGHT = 112;

View test_view() {
  const auto view = View::create(
      WIDTH, HEIGHT, perspective(symmetric_window(1.0, static_cast<double>(WIDTH) / HEIGHT), 0.1, INFINITE_FAR),
      glm::dmat4(1.0));
  return view.value();
}

/// A wall 10 m ahead; the left half of the picture, or none of it, is sky.
std::vector<float> wall_depth(bool half_sky = false) {
  std::vector<float> depth(std::size_t{WIDTH} * HEIGHT, static_cast<float>(0.1 / 10.0));
  for (std::size_t i = 0; half_sky && i < depth.size(); ++i)
    if (i % WIDTH < WIDTH / 2) depth[i] = 0.0F;
  return depth;
}

/// Lights in a box that holds the visible part of the wall.
std::vector<shared::Light> random_lights(std::size_t count, float range, bool spots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::vector<Light> lights(count);
  for (Light& light : lights) {
    light.position = {9.5F * unit(random), 5.5F * unit(random), -10.0F + 3.0F * unit(random)};
    light.range = range;
    light.direction = {unit(random), unit(random), unit(random) - 2.0F};
    light.outer_angle = 0.5F;
    light.type = spots ? LightType::spot : LightType::point;
  }
  return pack(lights);
}

Calibration even_calibration() {
  Calibration calibration{.device = "d", .driver = "e"};
  for (std::size_t i = 0; i < auto_candidates().size(); ++i)
    calibration.costs.push_back({.cull = {1, 1, 1, 1, 1, 1}, .shade = {1, 1, 1, 1}});
  return calibration;
}

std::size_t candidate(const std::string& label) {
  const auto all = auto_candidates();
  return static_cast<std::size_t>(std::ranges::find(all, label, [](const AutoCandidate& c) { return c.label(); }) -
                                  all.begin());
}

Workload some_workload(std::uint32_t lights) {
  const TileLoad load{
      .column = 60, .interval = 30, .walked = 30, .slab = 20, .exact = 15, .cells = 3, .entries = 2, .tested = 32};
  return {.width = 1920, .height = 1080, .lights = lights, .capacity = lights, .tile8 = load, .tile16 = load};
}

TEST(Workload, MeetsTheOracle) {
  const View view = test_view();
  const std::vector<float> depth = wall_depth();
  for (const bool spots : {false, true}) {
    const std::vector<shared::Light> lights = random_lights(600, 1.5F, spots);
    const Truth exact = truth({.view = view, .depth = depth, .lights = lights, .rows = HEIGHT});
    const double reached = static_cast<double>(exact.lights.size()) / (WIDTH * HEIGHT);
    const Workload w = estimate_workload(view, depth, lights);
    EXPECT_EQ(w.lights, 600U);
    EXPECT_EQ(w.capacity, 600U);
    EXPECT_GT(reached, 0.3);
    EXPECT_NEAR(w.reached / reached, 1.0, 0.15) << spots;
  }
}

// An orthographic view sees behind its eye.
TEST(Workload, MeetsTheOracleBehindTheEye) {
  glm::dmat4 view_from_world(1.0);
  view_from_world[3].z = 20.0;  // the wall is 10 m behind
  const Window window{.left = -8.5, .right = 8.5, .bottom = -5.0, .top = 5.0};
  const View view = View::create(WIDTH, HEIGHT, orthographic(window, -30.0, 10.0), view_from_world).value();
  const std::vector<float> depth(std::size_t{WIDTH} * HEIGHT, 0.5F);
  ASSERT_NEAR(view.z_view(0.5), -10.0, 1e-5);
  std::vector<shared::Light> lights = random_lights(600, 1.5F, false);
  const Truth exact = truth({.view = view, .depth = depth, .lights = lights, .rows = HEIGHT});
  const Workload w = estimate_workload(view, depth, lights);
  EXPECT_GT(exact.lights.size(), 0U);
  EXPECT_NEAR(w.reached * WIDTH * HEIGHT / static_cast<double>(exact.lights.size()), 1.0, 0.15);
  EXPECT_GT(w.tile16.interval, w.reached);
  for (shared::Light& light : lights) light.position.z += 10.0F;  // behind the wall, by far more than they reach
  EXPECT_EQ(estimate_workload(view, depth, lights).tile16.interval, 0.0);
  for (shared::Light& light : lights) light.position.z -= 20.0F;  // between the wall and the eye
  EXPECT_EQ(estimate_workload(view, depth, lights).tile16.interval, 0.0);
}

TEST(Workload, CloserTestsKeepFewerLights) {
  const Workload w = estimate_workload(test_view(), wall_depth(), random_lights(2000, 0.8F, true));
  for (const TileLoad& load : {w.tile8, w.tile16}) {
    EXPECT_GT(load.column, load.interval);
    EXPECT_GE(load.interval, load.slab);
    EXPECT_GT(load.slab, load.exact);
    EXPECT_GE(load.exact, w.reached);
    EXPECT_EQ(load.interval, load.walked);
    EXPECT_GT(load.cells, load.entries);
    EXPECT_GT(load.entries, 0.0);
    EXPECT_EQ(load.tested, load.entries * 16);  // tiles of a cell, in a small picture
  }
  EXPECT_LT(w.tile8.interval, w.tile16.interval);
}

TEST(Workload, SamplesOfManyLightsStandForAll) {
  const View view = test_view();
  const Workload few = estimate_workload(view, wall_depth(), random_lights(10'000, 0.5F, false));
  const Workload many = estimate_workload(view, wall_depth(), random_lights(100'000, 0.5F, false));
  EXPECT_NEAR(many.reached / few.reached, 10.0, 1.0);
  EXPECT_NEAR(many.tile16.interval / few.tile16.interval, 10.0, 1.0);
  EXPECT_NEAR(many.tile16.cells / few.tile16.cells, 1.0, 0.1);
}

TEST(Workload, LongListsAreWalkedAsAllLights) {
  const Workload w = estimate_workload(test_view(), wall_depth(), random_lights(1000, 100.0F, false));
  EXPECT_NEAR(w.reached, 1000.0, 1e-6);
  EXPECT_NEAR(w.tile16.walked, 1000.0, 1e-6);
}

/// As long as a pixel's list is too long for its tile, whoever else there is.
TEST(Workload, LongListsAreWalkedAsLightsElsewhereToo) {
  std::vector<shared::Light> lights = random_lights(1000, 100.0F, false);
  const std::vector<shared::Light> elsewhere(500, pack(Light{.position = {1e6F, 0, -10}, .range = 1.0F}));
  lights.insert(lights.end(), elsewhere.begin(), elsewhere.end());
  const Workload w = estimate_workload(test_view(), wall_depth(), lights);
  EXPECT_NEAR(w.tile16.interval, 1000.0, 1e-6);
  EXPECT_NEAR(w.tile16.walked, 1500.0, 1e-6);
}

TEST(Workload, ConesReachLessThanTheirSpheres) {
  const View view = test_view();
  const Workload spots = estimate_workload(view, wall_depth(), random_lights(2000, 3.0F, true));
  const Workload points = estimate_workload(view, wall_depth(), random_lights(2000, 3.0F, false));
  EXPECT_LT(spots.tile8.exact, 0.5 * spots.tile8.interval);
  EXPECT_GT(points.tile8.exact, 0.5 * points.tile8.interval);
}

TEST(Workload, NothingIsSeenBehindAPerspectivesEye) {
  std::vector<shared::Light> lights = random_lights(500, 1.5F, false);
  for (shared::Light& light : lights) light.position = {0.0F, 0.0F, 1.6F};
  EXPECT_EQ(estimate_workload(test_view(), wall_depth(), lights).tile16.column, 0.0);
}

TEST(Workload, SkyAndNothing) {
  const View view = test_view();
  const std::vector<shared::Light> lights = random_lights(500, 2.0F, false);
  const Workload all = estimate_workload(view, wall_depth(), lights);
  const Workload half = estimate_workload(view, wall_depth(true), lights);
  EXPECT_NEAR(half.reached / all.reached, 0.5, 0.15);
  const std::vector<float> sky(std::size_t{WIDTH} * HEIGHT, 0.0F);
  EXPECT_EQ(estimate_workload(view, sky, lights).tile16.interval, 0.0);
  EXPECT_EQ(estimate_workload(view, wall_depth(), {}).tile16.column, 0.0);
  EXPECT_GT(estimate_workload(view, {}, lights).tile16.exact, 0.0) << "without depth, surfaces are anywhere";
}

TEST(Workload, AnyProjectionAndSize) {
  const auto flat = View::create(1, 1, orthographic({-5, 5, -3, 3}, 0.1, 100.0), glm::dmat4(1.0)).value();
  std::vector<Light> lights(3);
  lights[0].range = std::numeric_limits<float>::infinity();
  lights[1].range = 0.0F;
  lights[2].type = LightType::spot;
  const Workload w = estimate_workload(flat, std::vector<float>{0.5F}, pack(lights));
  EXPECT_TRUE(std::isfinite(w.tile16.cells));
  EXPECT_GE(w.tile16.exact, 1.0);
}

TEST(FitCost, FindsTheCostsThatMadeTheSamples) {
  for (const AutoCandidate& c : auto_candidates()) {
    SCOPED_TRACE(c.label());
    std::vector<CostSample> samples;
    for (const std::uint32_t width : {320U, 1280U, 1920U})
      for (const std::uint32_t lights : {64U, 1024U, 16384U}) {
        Workload w = some_workload(lights);
        w.width = width;
        CostSample sample{.workload = w};
        const CullTerms cull = cull_terms(c, w);
        const ShadeTerms shade = shade_terms(c, w);
        for (std::size_t i = 0; i < CULL_TERMS; ++i) sample.cull_ms += 0.1 * static_cast<double>(i + 1) * cull[i];
        for (std::size_t i = 0; i < SHADE_TERMS; ++i) sample.shade_ms += 0.2 * static_cast<double>(i + 1) * shade[i];
        samples.push_back(sample);
      }
    const CandidateCost cost = fit_cost(c, samples);
    for (const CostSample& sample : samples) {  // terms that move together may share: what counts is the sum
      double cull = 0.0;
      double shade = 0.0;
      for (std::size_t i = 0; i < CULL_TERMS; ++i) cull += cost.cull[i] * cull_terms(c, sample.workload)[i];
      for (std::size_t i = 0; i < SHADE_TERMS; ++i) shade += cost.shade[i] * shade_terms(c, sample.workload)[i];
      EXPECT_NEAR(cull, sample.cull_ms, 0.01 * sample.cull_ms);
      EXPECT_NEAR(shade, sample.shade_ms, 0.01 * sample.shade_ms);
    }
    for (const double coefficient : cost.cull) EXPECT_GE(coefficient, 0.0);
    for (const double coefficient : cost.shade) EXPECT_GE(coefficient, 0.0);
  }
}

TEST(FitCost, NeverNegative) {
  // Time that falls with the number of lights: nothing explains it, and nothing may be paid for it.
  std::vector<CostSample> samples;
  for (const std::uint32_t lights : {64U, 1024U, 16384U})
    samples.push_back({.workload = some_workload(lights), .cull_ms = 100.0 / lights, .shade_ms = 100.0 / lights});
  const CandidateCost cost = fit_cost(auto_candidates()[candidate("tiled")], samples);
  for (const double coefficient : cost.cull) EXPECT_GE(coefficient, 0.0);
  EXPECT_EQ(fit_cost(auto_candidates()[0], {}).shade, ShadeTerms{}) << "no samples, no costs";
}

// As often too short as too long a time by the same factor: of 1 and 100 ms the fit is near 1, not in the middle.
TEST(FitCost, WeighsErrorsByTheTimesThatTheyAreOf) {
  const AutoCandidate& all = auto_candidates()[candidate("all")];
  const Workload w = some_workload(64);
  const CandidateCost cost =
      fit_cost(all, std::vector<CostSample>{{.workload = w, .shade_ms = 1.0}, {.workload = w, .shade_ms = 100.0}});
  double ms = 0.0;
  for (std::size_t i = 0; i < SHADE_TERMS; ++i) ms += cost.shade[i] * shade_terms(all, w)[i];
  EXPECT_NEAR(ms, (1.0 + 0.01) / (1.0 + 0.0001), 1e-6);
}

TEST(AutoCandidates, AreMethodsWithTheirOptions) {
  for (const AutoCandidate& c : auto_candidates()) {
    const auto method = find_method(c.method);
    ASSERT_TRUE(method.ok()) << c.method;
    EXPECT_FALSE(method.value()->approximate) << "what may miss lights is no candidate";
    EXPECT_TRUE(resolve_options(*method.value(), c.settings()).ok()) << c.label();
    EXPECT_LE(c.least_capacity, c.most_capacity) << c.label();
  }
  for (const char* label : {"all", "tiled", "tiled-bits", "clustered", "tight", "lamplight", "lamplight tile=8",
                            "lamplight cells=gather", "lamplight tile=8 cells=gather", "drobot-zbin"})
    EXPECT_LT(candidate(label), auto_candidates().size()) << label;
}

DeviceTraits large_device() {
  return {.max_storage_buffer_bytes = 1ULL << 32,
          .max_groups = {1U << 31, 65535, 65535},
          .max_group_invocations = 1024,
          .shared_memory_bytes = 49152,
          .max_image_size = 32768};
}

TEST(Choose, TakesTheLeast) {
  for (std::size_t i = 0; i < auto_candidates().size(); ++i) {
    Calibration calibration = even_calibration();
    calibration.costs[i] = {};
    const std::uint32_t lights = std::min(4096U, auto_candidates()[i].most_capacity);
    const Choice choice = choose(calibration, some_workload(lights), large_device());
    EXPECT_EQ(choice.predicted.label, auto_candidates()[i].label());
    EXPECT_EQ(choice.method, auto_candidates()[i].method);
    EXPECT_EQ(choice.predictions.size(), auto_candidates().size());
    EXPECT_FALSE(choice.reason.empty());
  }
}

TEST(Choose, PredictsBySumsOfTerms) {
  Calibration calibration = even_calibration();
  calibration.costs[candidate("tiled")] = {.cull = {0.5, 0, 0, 2.0, 0, 0}, .shade = {0, 0, 3.0, 0}};
  const Choice choice = choose(calibration, some_workload(4096), large_device());
  const Prediction& tiled = choice.predictions[candidate("tiled")];
  const double tiles = 120.0 * 68.0;
  EXPECT_NEAR(tiled.cull_ms, 0.5 + 2.0 * 4096.0 * tiles / 1e7, 1e-9);
  EXPECT_NEAR(tiled.shade_ms, 3.0 * 1920.0 * 1080.0 * 30.0 / 1e7, 1e-9);
}

/// By hand, from docs/auto.md.
TEST(Choose, TermsCountWhatEachMethodDoes) {
  const Workload w = some_workload(4096);
  const double pixels = 1920.0 * 1080.0;
  const double tiles = 120.0 * 68.0;
  const auto terms = [&](const char* label) { return cull_terms(auto_candidates()[candidate(label)], w); };
  EXPECT_DOUBLE_EQ(terms("tiled")[3], 4096.0 * tiles / 1e7) << "every light at every tile";
  EXPECT_DOUBLE_EQ(terms("tiled")[5], 0.0);
  EXPECT_DOUBLE_EQ(terms("tight")[5], pixels * w.tile16.interval / 1e7) << "pixels look at a tile's lights";
  EXPECT_DOUBLE_EQ(terms("lamplight")[3], 4096.0 * w.tile16.tested / 1e7) << "the tiles of a light's cells alone";
  EXPECT_DOUBLE_EQ(terms("lamplight")[5], 4096.0 * w.tile16.cells / 1e7);
  EXPECT_DOUBLE_EQ(shade_terms(auto_candidates()[candidate("tiled-bits")], w)[3], pixels * 128.0 / 1e7);
  EXPECT_DOUBLE_EQ(shade_terms(auto_candidates()[candidate("tiled")], w)[3], 0.0);
}

TEST(Choose, WhatCannotRunIsNoCandidate) {
  Calibration calibration = even_calibration();
  calibration.costs[candidate("tiled-bits")] = {};  // by far the least, if only it could
  DeviceTraits small = large_device();
  small.max_storage_buffer_bytes = 1ULL << 27;
  const Choice choice = choose(calibration, some_workload(1U << 20U), small);
  EXPECT_NE(choice.method, "tiled-bits");
  EXPECT_FALSE(choice.predictions[candidate("tiled-bits")].refused.empty());
}

TEST(Choose, NoRoomForLightsIsNothingToCull) {
  Calibration calibration = even_calibration();
  for (CandidateCost& cost : calibration.costs) cost = {.cull = {2.0}};
  calibration.costs[candidate("all")] = {.shade = {5.0}};
  calibration.costs[candidate("tight")] = {.cull = {1.7}};
  Workload none = some_workload(0);
  none.capacity = 10;
  const Choice tight = choose(calibration, none, large_device());
  EXPECT_EQ(tight.method, "tight") << "there may be lights in the next frame";
  EXPECT_EQ(tight.reason, "the least predicted time of cull and shading; next is tiled (1.18 times)");
  none.capacity = 0;
  EXPECT_EQ(choose(calibration, none, large_device()).method, "all");
}

TEST(Choose, GivesLamplightRoom) {
  Calibration calibration = even_calibration();
  calibration.costs[candidate("lamplight")] = {};
  Workload w = some_workload(4096);
  EXPECT_TRUE(choose(calibration, w, large_device()).options.empty());
  w.tile16.entries = 400.0;
  w.tile16.exact = 100.0;
  EXPECT_EQ(choose(calibration, w, large_device()).options,
            (std::vector<std::string>{"mean_cells=800", "mean_capacity=200"}));
  w.tile16.entries = 3000.0;
  EXPECT_EQ(choose(calibration, w, large_device()).options.front(), "mean_cells=4096") << "the most that there is";
}

TEST(Choose, CellsGatherFewLightsAlone) {
  Calibration calibration = even_calibration();
  const std::size_t gather = candidate("lamplight cells=gather");
  const std::size_t plain = candidate("lamplight");
  calibration.costs[plain] = {};
  const Choice few = choose(calibration, some_workload(128), large_device());
  EXPECT_NE(few.predicted.label, "lamplight") << "it is no such thing with so few lights";
  EXPECT_FALSE(few.predictions[plain].refused.empty());
  EXPECT_TRUE(few.predictions[gather].refused.empty());
  const Choice more = choose(calibration, some_workload(129), large_device());
  EXPECT_EQ(more.predicted.label, "lamplight");
  EXPECT_FALSE(more.predictions[gather].refused.empty());
  DeviceTraits small_buffers = large_device();
  small_buffers.max_storage_buffer_bytes = 4'000'000;
  const Choice small = choose(calibration, some_workload(128), small_buffers);
  EXPECT_FALSE(small.predictions[gather].refused.empty()) << "room for every light in every tile is too much for it";
  EXPECT_TRUE(small.predictions[plain].refused.empty());
}

TEST(Choose, CellsGatherBoxesToo) {
  Calibration calibration = even_calibration();
  const std::size_t gather = candidate("lamplight cells=gather");
  const std::size_t plain = candidate("lamplight");
  calibration.costs[gather] = {};
  calibration.costs[plain] = {.cull = {0.1}};
  Workload few = some_workload(100);
  EXPECT_EQ(choose(calibration, few, large_device()).predicted.label, "lamplight cells=gather");
  few.boxes = 3;
  const Choice with_boxes = choose(calibration, few, large_device());
  EXPECT_EQ(with_boxes.predicted.label, "lamplight cells=gather");
  EXPECT_EQ(with_boxes.options.size(), 1U) << "how boxes are culled is the frame's to say";
  few.boxes = 300;
  EXPECT_FALSE(choose(calibration, few, large_device()).predictions[gather].refused.empty()) << "they are too many";
}

TEST(Choose, BoxesTakeRoomAsLightsDo) {
  const AutoCandidate& bits = auto_candidates()[candidate("tiled-bits")];
  Workload w = some_workload(4096);
  const double words = shade_terms(bits, w).back();
  w.boxes = 4096;
  EXPECT_DOUBLE_EQ(shade_terms(bits, w).back(), 2.0 * words);
  Workload boxes_alone = some_workload(0);
  boxes_alone.capacity = 0;
  boxes_alone.boxes = 10;
  Calibration calibration = even_calibration();
  calibration.costs[candidate("tight")] = {};
  EXPECT_EQ(choose(calibration, boxes_alone, large_device()).method, "tight") << "there are boxes to cull";
}

TEST(Choose, IsTheSameEveryTime) {
  const Calibration calibration = even_calibration();
  const Choice a = choose(calibration, some_workload(4096), large_device());
  const Choice b = choose(calibration, some_workload(4096), large_device());
  EXPECT_EQ(a.predicted.label, b.predicted.label);
  EXPECT_EQ(a.reason, b.reason);
}

}  // namespace
}  // namespace lamp
