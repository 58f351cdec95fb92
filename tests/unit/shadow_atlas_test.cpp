// The shadow atlas's schedule: squares that do not overlap, sizes, budgets, what is kept, what is counted.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shadow_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "lamplight/light.h"
#include "random.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::ShadowAtlas;
using lamp::ShadowAtlasInfo;
using lamp::ShadowFrame;
using lamp::ShadowFrameInfo;
using lamp::View;
namespace shared = lamp::shared;

View view_from(const glm::dvec3& eye, const glm::dvec3& target = glm::dvec3(0.0)) {
  return View::create(1280, 720, lamp::perspective(lamp::symmetric_window(1.0, 16.0 / 9.0), 0.05, lamp::INFINITE_FAR),
                      glm::lookAt(eye, target, glm::dvec3(0.0, 1.0, 0.0)))
      .value();
}

std::vector<shared::Light> random_lights(std::size_t count, std::uint32_t seed, float spots = 0.5F) {
  lamp::test::Random random(seed);
  std::vector<Light> lights;
  for (std::size_t i = 0; i < count; ++i)
    lights.push_back({.type = random.in(0.0F, 1.0F) < spots ? LightType::spot : LightType::point,
                      .position = random.vector(20.0F),
                      .range = random.in(0.5F, 5.0F),
                      .direction = random.vector(1.0F) + glm::vec3(0.001F),
                      .outer_angle = random.in(0.05F, 1.57F)});
  return lamp::pack(lights);
}

shared::Light spot_at(const glm::vec3& position) {
  return lamp::pack(
      Light{.type = LightType::spot, .position = position, .range = 2.0F, .direction = {0.0F, -1.0F, 0.0F}});
}

ShadowAtlas make(const ShadowAtlasInfo& info) { return std::move(ShadowAtlas::create(info).value()); }

/// Holds what every frame promises against the frame.
void expect_sound(const ShadowFrame& frame, const ShadowAtlasInfo& info, std::uint64_t budget = lamp::ALL_TEXELS) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken;  // in units of the least square
  for (const shared::ShadowMap& map : frame.maps) {
    if (map.kind == shared::SHADOW_NONE) continue;
    ASSERT_TRUE(map.side >= shared::LEAST_SQUARE && map.side <= shared::MOST_SQUARE &&
                (map.side & (map.side - 1)) == 0);
    for (std::uint32_t i = 0; i < (map.kind == shared::SHADOW_FACES ? 6U : 1U); ++i) {
      const std::uint32_t left = map.squares[i] & 0xffffU;
      const std::uint32_t top = map.squares[i] >> 16U;
      const std::uint32_t units = map.side / shared::LEAST_SQUARE;
      ASSERT_LE((std::max(left, top) + units) * shared::LEAST_SQUARE, info.size);
      for (std::uint32_t y = top; y < top + units; ++y)
        for (std::uint32_t x = left; x < left + units; ++x)
          ASSERT_TRUE(taken.emplace(x, y).second) << "two squares at " << x << ", " << y;
    }
  }
  std::uint64_t texels = 0;
  std::uint32_t views = 0;
  for (const lamp::ShadowRedraw& redraw : frame.redraws) {
    EXPECT_EQ(redraw.first_view, views);
    views += redraw.views;
    texels += redraw.texels;
    for (std::uint32_t i = 0; i < redraw.views; ++i) EXPECT_EQ(frame.views[redraw.first_view + i].light, redraw.light);
  }
  EXPECT_EQ(views, frame.views.size());
  std::uint64_t cleared = 0;
  for (const lamp::ShadowSquare& square : frame.squares) cleared += std::uint64_t{square.side} * square.side;
  EXPECT_EQ(cleared, texels);
  EXPECT_EQ(texels, frame.counts.redrawn_texels);
  EXPECT_LE(texels, budget);
  EXPECT_EQ(frame.counts.shadowed + frame.counts.without, frame.counts.seen);
  EXPECT_EQ(frame.counts.waiting, frame.waiting.size());
  EXPECT_EQ(frame.counts.without, frame.without.size());
  EXPECT_TRUE(std::ranges::is_sorted(frame.waiting) && std::ranges::is_sorted(frame.without));
}

TEST(ShadowAtlas, HoldsForMovingLightsAndCameras) {
  for (const lamp::PointShadows points : {lamp::PointShadows::faces, lamp::PointShadows::octahedron}) {
    for (const std::uint32_t size : {64U, 512U, 2048U}) {
      const ShadowAtlasInfo info{.size = size, .light_capacity = 128, .points = points};
      ShadowAtlas atlas = make(info);
      std::vector<shared::Light> lights = random_lights(100, size);
      lamp::test::Random random(7);
      for (int i = 0; i < 60; ++i) {
        for (std::size_t k = 0; k < lights.size(); k += 3)
          lights[k].position = glm::vec3(lights[k].position) + random.vector(0.3F);
        // Lights come and go, too.
        const std::size_t count = i % 7 == 0 ? 60 : lights.size();
        const View view = view_from(glm::dvec3(random.vector(25.0F)));
        const std::uint64_t budget = i % 5 == 0 ? 5000 : 200000;
        const auto frame = atlas.schedule(
            {.views = std::span(&view, 1), .lights = std::span(lights).first(count), .budget_texels = budget});
        ASSERT_TRUE(frame.ok());
        expect_sound(frame.value(), info, budget);
        EXPECT_LE(frame.value().counts.used_texels, std::uint64_t{size} * size);
      }
    }
  }
}

TEST(ShadowAtlas, DrawsAStillSceneOnce) {
  for (const std::uint32_t size : {256U, 1024U, 4096U}) {
    const ShadowAtlasInfo info{.size = size, .light_capacity = 300};
    ShadowAtlas atlas = make(info);
    const std::vector<shared::Light> lights = random_lights(300, 3);
    const View view = view_from({0.0, 3.0, 22.0});
    const ShadowFrameInfo frame{.views = std::span(&view, 1), .lights = lights};
    const auto first = atlas.schedule(frame);
    expect_sound(first.value(), info);
    EXPECT_GT(first.value().counts.redrawn, 0U);
    const std::vector<shared::ShadowMap> maps(first.value().maps.begin(), first.value().maps.end());
    for (int i = 0; i < 600; ++i) {
      const auto next = atlas.schedule(frame);
      ASSERT_EQ(next.value().counts.redrawn, 0U) << "frame " << i << " of size " << size;
      ASSERT_EQ(next.value().counts.moved, 0U);
    }
    const auto last = atlas.schedule(frame);
    for (std::size_t i = 0; i < maps.size(); ++i)
      EXPECT_TRUE(std::ranges::equal(maps[i].squares, last.value().maps[i].squares)) << i;
  }
}

TEST(ShadowAtlas, KeepsSizesWhileTheCameraTrembles) {
  ShadowAtlas atlas = make({.light_capacity = 200});
  const std::vector<shared::Light> lights = random_lights(200, 11);
  std::uint32_t moved = 0;
  for (int i = 0; i < 200; ++i) {
    const View view = view_from({0.0, 3.0, 22.0 + 0.3 * std::sin(i)});
    const auto frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights});
    // Some lights come to their size in the first frames, and none goes back and forth.
    if (i >= 20) moved += frame.value().counts.redrawn;
  }
  EXPECT_EQ(moved, 0U);
}

TEST(ShadowAtlas, SizesFallBeforeALightLosesItsShadow) {
  const View view = view_from({0.0, 30.0, 30.0});
  for (const float texels : {1.0F, 1e6F}) {
    const ShadowAtlasInfo info{.size = 256, .light_capacity = 257, .texels_per_pixel = texels};
    std::vector<shared::Light> lights;
    std::uint32_t side = 256;
    for (const std::size_t count : {1, 4, 16, 64, 255, 256, 257}) {
      while (lights.size() < count)
        lights.push_back(
            spot_at({static_cast<float>(lights.size() % 16), 0.0F, static_cast<float>(lights.size()) / 16.0F}));
      ShadowAtlas atlas = make(info);
      const auto frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights});
      expect_sound(frame.value(), info);
      EXPECT_EQ(frame.value().counts.seen, count);
      EXPECT_EQ(frame.value().counts.shadowed, std::min<std::size_t>(count, 256)) << texels;
      EXPECT_EQ(frame.value().counts.no_room, count == 257 ? 1U : 0U);
      ASSERT_EQ(frame.value().without.size(), count == 257 ? 1U : 0U);
      EXPECT_LE(frame.value().maps[0].side, side);
      side = frame.value().maps[0].side;
    }
    EXPECT_EQ(side, 16U);
  }
}

TEST(ShadowAtlas, AnIdThatIsUsedAgainHasNotWaited) {
  const View view = view_from({0.0, 30.0, 30.0});
  const std::vector<shared::Light> lights{spot_at({})};
  const lamp::ShadowFrameInfo frame{.views = std::span(&view, 1), .lights = lights};
  const auto priority = [&](ShadowAtlas& atlas) { return atlas.schedule(frame).value().redraws[0].priority; };
  ShadowAtlas fresh = make({.light_capacity = 1});
  ShadowAtlas used = make({.light_capacity = 1});
  lamp::ShadowFrameInfo poor = frame;
  poor.budget_texels = 0;
  for (int i = 0; i < 100; ++i) (void)used.schedule(poor).value();
  (void)used.schedule({.views = frame.views}).value();
  EXPECT_EQ(priority(used), priority(fresh));
}

TEST(ShadowAtlas, LightsThatComeLaterGetTheirShadowWithinAFewFrames) {
  const ShadowAtlasInfo info{.size = 512, .light_capacity = 1024};
  ShadowAtlas atlas = make(info);
  const View view = view_from({0.0, 30.0, 30.0});
  std::vector<shared::Light> lights;
  lamp::test::Random random(5);
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 100; ++i) lights.push_back(spot_at(random.vector(5.0F)));
    constexpr std::uint64_t BUDGET = 64 * 1024;
    std::uint32_t without = 0;
    for (int i = 0; i < 8; ++i) {
      const auto frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights, .budget_texels = BUDGET});
      expect_sound(frame.value(), info, BUDGET);
      without = frame.value().counts.without;
    }
    EXPECT_EQ(without, 0U) << lights.size();
  }
}

TEST(ShadowAtlas, TheLeastRecentlySeenGoesFirst) {
  const ShadowAtlasInfo info{.size = 32, .light_capacity = 8};  // room for four lights
  ShadowAtlas atlas = make(info);
  std::vector<shared::Light> lights;
  for (int i = 0; i < 6; ++i) lights.push_back(spot_at({1000.0F * static_cast<float>(i), 0.0F, 0.0F}));
  const auto look_at = [&](const std::vector<int>& seen) {
    std::vector<View> views;
    for (const int i : seen) views.push_back(view_from({1000.0 * i, 0.0, 120.0}, {1000.0 * i, 0.0, 0.0}));
    return atlas.schedule({.views = views, .lights = lights}).value();
  };
  // So far away that each asks for the least square.
  for (const int i : {0, 1, 2, 3}) static_cast<void>(look_at({i}));
  const ShadowFrame all = look_at({0, 1, 2, 3});
  EXPECT_EQ(all.counts.shadowed, 4U);
  EXPECT_EQ(all.counts.used_texels, 32U * 32U);
  static_cast<void>(look_at({2}));
  static_cast<void>(look_at({0}));
  static_cast<void>(look_at({3}));
  const ShadowFrame next = look_at({3, 4});
  EXPECT_GE(next.counts.evicted, 1U);
  EXPECT_EQ(next.maps[1].kind, shared::SHADOW_NONE) << "light 1 was not seen for the longest time";
  EXPECT_NE(next.maps[3].kind, shared::SHADOW_NONE);
  EXPECT_NE(next.maps[4].kind, shared::SHADOW_NONE);
}

/// A map that nobody looks up makes none smaller that is looked up.
TEST(ShadowAtlas, WhoIsNotSeenGoesBeforeSizesFall) {
  const ShadowAtlasInfo info{.size = 256, .light_capacity = 4, .texels_per_pixel = 1e6F};
  ShadowAtlas atlas = make(info);
  std::vector<shared::Light> lights;
  for (int i = 0; i < 4; ++i) lights.push_back(spot_at({1000.0F * static_cast<float>(i), 0.0F, 0.0F}));
  const auto look_at = [&](const std::vector<int>& seen) {
    std::vector<View> views;
    for (const int i : seen) views.push_back(view_from({1000.0 * i, 0.0, 20.0}, {1000.0 * i, 0.0, 0.0}));
    return atlas.schedule({.views = views, .lights = lights}).value();
  };
  EXPECT_EQ(look_at({0, 1, 2}).maps[0].side, 128U);
  const ShadowFrame next = look_at({3});
  EXPECT_EQ(next.maps[3].side, 256U);
  EXPECT_EQ(next.counts.evicted, 3U);
}

TEST(ShadowAtlas, EveryMovingLightGetsItsTurn) {
  const ShadowAtlasInfo info{.size = 1024, .light_capacity = 64, .points = lamp::PointShadows::octahedron};
  ShadowAtlas atlas = make(info);
  std::vector<shared::Light> lights = random_lights(64, 9);
  const View view = view_from({0.0, 0.0, 60.0});
  std::map<std::uint32_t, int> drawn;
  constexpr std::uint64_t BUDGET = 32 * 1024;
  for (int i = 0; i < 300; ++i) {
    for (shared::Light& light : lights) light.position.x += 0.001F;
    const auto frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights, .budget_texels = BUDGET});
    expect_sound(frame.value(), info, BUDGET);
    EXPECT_TRUE(i == 0 || frame.value().counts.waiting > 0);
    for (const lamp::ShadowRedraw& redraw : frame.value().redraws) ++drawn[redraw.light];
  }
  ASSERT_EQ(drawn.size(), lights.size());
  for (const auto& [light, times] : drawn) EXPECT_GE(times, 3) << light;
}

TEST(ShadowAtlas, DrawsWhatMovedAndWhatSomethingMovedNear) {
  ShadowAtlas atlas = make({.light_capacity = 16});
  std::vector<shared::Light> lights;
  for (int i = 0; i < 10; ++i) lights.push_back(spot_at({10.0F * static_cast<float>(i) - 50.0F, 0.0F, 0.0F}));
  const View view = view_from({0.0, 0.0, 100.0});
  ShadowFrameInfo frame{.views = std::span(&view, 1), .lights = lights};
  EXPECT_EQ(atlas.schedule(frame).value().counts.redrawn, 10U);
  lights[3].position.y += 0.5F;
  lights[4].intensity = glm::vec3(lights[4].intensity) * 2.0F;  // casts the same shadow
  const ShadowFrame moved = atlas.schedule(frame).value();
  ASSERT_EQ(moved.redraws.size(), 1U);
  EXPECT_EQ(moved.redraws[0].light, 3U);
  EXPECT_EQ(moved.maps[3].position, lights[3].position);
  EXPECT_EQ(moved.counts.moved, 0U) << "its squares are the same";

  const shared::LightSphere ball{.center = glm::vec3(lights[7].position) + glm::vec3(0.0F, 2.5F, 0.0F), .radius = 0.6F};
  frame.moved = std::span(&ball, 1);
  const ShadowFrame near = atlas.schedule(frame).value();
  ASSERT_EQ(near.redraws.size(), 1U);
  EXPECT_EQ(near.redraws[0].light, 7U);

  // While nobody looks: drawn when it is seen again.
  const View away = view_from({0.0, 0.0, 100.0}, {0.0, 0.0, 200.0});
  frame.views = std::span(&away, 1);
  EXPECT_EQ(atlas.schedule(frame).value().counts.redrawn, 0U);
  frame.views = std::span(&view, 1);
  frame.moved = {};
  EXPECT_EQ(atlas.schedule(frame).value().counts.redrawn, 1U);
  atlas.redraw_all();
  EXPECT_EQ(atlas.schedule(frame).value().counts.redrawn, 10U);
}

TEST(ShadowAtlas, ABudgetOfNothingKeepsWhatIsThere) {
  ShadowAtlas atlas = make({.light_capacity = 16});
  std::vector<shared::Light> lights{spot_at({0.0F, 0.0F, 0.0F}), spot_at({3.0F, 0.0F, 0.0F})};
  const View view = view_from({0.0, 0.0, 20.0});
  ShadowFrameInfo frame{.views = std::span(&view, 1), .lights = lights, .budget_texels = 0};
  const ShadowFrame none = atlas.schedule(frame).value();
  EXPECT_EQ(none.counts.redrawn, 0U);
  EXPECT_EQ(none.counts.waiting, 2U);
  EXPECT_EQ(none.counts.without, 2U);
  frame.budget_texels = lamp::ALL_TEXELS;
  EXPECT_EQ(atlas.schedule(frame).value().counts.redrawn, 2U);
  frame.budget_texels = 0;
  EXPECT_EQ(atlas.schedule(frame).value().counts.waiting, 0U) << "nothing is to be drawn";
  lights[1].position.x += 1.0F;
  const ShadowFrame kept = atlas.schedule(frame).value();
  EXPECT_EQ(kept.counts.redrawn, 0U);
  EXPECT_EQ(kept.counts.shadowed, 2U);
  ASSERT_EQ(kept.waiting.size(), 1U) << "one has moved";
  EXPECT_EQ(kept.waiting[0], 1U);
  EXPECT_EQ(kept.maps[1].position.x, 3.0F) << "the map says where the light was when it was drawn";
}

TEST(ShadowAtlas, OddLights) {
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<Light> odd{
      {.range = 0.0F},
      {.range = 2.0F, .intensity = 0.0F},
      {.type = LightType::spot, .outer_angle = 0.0F},
      {.range = infinite},
      {.type = LightType::spot, .range = infinite, .outer_angle = std::numbers::pi_v<float> / 2.0F},
      {.type = LightType::spot, .range = 1e-6F, .outer_angle = 1e-4F},
      {.type = LightType::spot, .range = 2.0F, .outer_angle = 1e-38F},
      {.position = {std::nanf(""), 0.0F, 0.0F}, .range = infinite},
      {.position = {infinite, 0.0F, 0.0F}, .range = infinite}};
  const std::vector<shared::Light> lights = lamp::pack(odd);
  ShadowAtlas atlas = make({.light_capacity = 16});
  const View view = view_from({0.0, 0.0, 1.0});
  const ShadowFrame frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights}).value();
  EXPECT_EQ(frame.counts.seen, 4U);
  EXPECT_EQ(frame.counts.without, 0U);
  for (const int i : {0, 1, 2, 7, 8}) EXPECT_EQ(frame.maps[i].kind, shared::SHADOW_NONE) << i;
  EXPECT_EQ(frame.maps[3].kind, shared::SHADOW_FACES);
  EXPECT_EQ(frame.maps[4].kind, shared::SHADOW_OCTAHEDRON) << "a spot of 90 degrees has no plane of its own";
  EXPECT_EQ(frame.maps[5].kind, shared::SHADOW_SPOT);
  for (const shared::ShadowView& v : frame.views)
    for (const glm::vec3 row : {v.row_x, v.row_y, v.row_w})
      EXPECT_TRUE(std::isfinite(row.x) && std::isfinite(row.y) && std::isfinite(row.z));
  EXPECT_EQ(atlas.schedule({.views = std::span(&view, 1), .lights = {}}).value().counts.used_texels, 0U);
  EXPECT_EQ(atlas.schedule({.lights = lights}).value().counts.seen, 0U) << "without a view nothing is seen";
}

TEST(ShadowAtlas, SaysWhatIsWrong) {
  const auto error = [](const ShadowAtlasInfo& info) {
    const auto made = ShadowAtlas::create(info);
    return made.ok() ? "nothing" : made.error().text();
  };
  EXPECT_EQ(error({.size = 1000}), "shadow atlas: size must be a power of two, 16 .. 32768 texels, got 1000");
  EXPECT_EQ(error({.size = 8}), "shadow atlas: size must be a power of two, 16 .. 32768 texels, got 8");
  EXPECT_EQ(error({.size = 32768, .max_image_size = 16384}),
            "shadow atlas: size must be at most 16384 texels on this device, got 32768");
  EXPECT_EQ(error({.size = 65536, .max_image_size = 65536}),
            "shadow atlas: size must be a power of two, 16 .. 32768 texels, got 65536");
  EXPECT_EQ(error({.light_capacity = 0}), "shadow atlas: light capacity must be >= 1, got 0");
  EXPECT_EQ(error({.texels_per_pixel = 0.0F}), "shadow atlas: texels per pixel must be finite and > 0, got 0.000000");
  EXPECT_EQ(error({.points = lamp::PointShadows(9)}), "shadow atlas: points must be faces or octahedron, got 9");
  EXPECT_EQ(error({.filter = lamp::ShadowFilter(9)}), "shadow atlas: filter must be hard, pcf, vsm or evsm, got 9");
  EXPECT_EQ(error({.size = 16, .light_capacity = 1}), "nothing");

  ShadowAtlas atlas = make({.light_capacity = 2});
  const std::vector<shared::Light> lights(3, spot_at({0.0F, 0.0F, 0.0F}));
  const auto fault = [&](std::vector<std::uint32_t> ids, std::size_t count) {
    const auto frame = atlas.schedule({.lights = std::span(lights).first(count), .ids = ids});
    return frame.ok() ? "nothing" : frame.error().text();
  };
  EXPECT_EQ(fault({}, 3), "light 2: shadow id must be less than the capacity 2, got 2");
  EXPECT_EQ(fault({1, 1}, 2), "light 1: shadow id 1 belongs to a light before it, too");
  EXPECT_EQ(fault({1}, 2), "shadow ids: expected one for each of 2 lights, got 1");
  EXPECT_EQ(fault({1, 0}, 2), "nothing");
}

TEST(ShadowAtlas, AThousandLightsInAFractionOfAMillisecond) {
  ShadowAtlas atlas = make({.light_capacity = 1000});
  std::vector<shared::Light> lights = random_lights(1000, 2);
  const View view = view_from({0.0, 3.0, 22.0});
  double best_ms = 1e9;
  for (int i = 0; i < 50; ++i) {
    for (std::size_t k = 0; k < lights.size(); k += 4) lights[k].position.x += 0.001F;
    const auto begin = std::chrono::steady_clock::now();
    const auto frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights});
    best_ms =
        std::min(best_ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    EXPECT_EQ(frame.value().counts.without, 0U);
  }
  RecordProperty("best_us", static_cast<int>(best_ms * 1e3));
  // With assertions, sanitizers and neighbours on the machine: far from what it takes, near enough to notice a square.
  EXPECT_LT(best_ms, 20.0);
}

}  // namespace
