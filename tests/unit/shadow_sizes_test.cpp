// The shadow atlas, light by light: which changes ask for a new map, how large maps are, what budgets and room leave.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"

namespace lamp {
namespace {

View view_from(double distance) {
  return View::create(1280, 720, perspective(symmetric_window(1.0, 16.0 / 9.0), 0.05, INFINITE_FAR),
                      glm::lookAt(glm::dvec3(0.0, 0.0, distance), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)))
      .value();
}

Light spot(float angle = 0.5F) {
  return {.type = LightType::spot, .range = 2.0F, .direction = {0.0F, -1.0F, 0.0F}, .outer_angle = angle};
}

class LightsOfAnAtlas {
 public:
  explicit LightsOfAnAtlas(const ShadowAtlasInfo& info) : atlas_(std::move(ShadowAtlas::create(info).value())) {}
  ShadowFrame schedule(const std::vector<Light>& lights, double distance = 20.0, std::uint64_t budget = ALL_TEXELS) {
    lights_ = pack(lights);
    view_ = view_from(distance);
    return atlas_.schedule({.views = std::span(&view_, 1), .lights = lights_, .budget_texels = budget}).value();
  }

 private:
  ShadowAtlas atlas_;
  std::vector<shared::Light> lights_;
  View view_ = view_from(20.0);
};

TEST(ShadowSizes, WhatCastsAnotherShadowIsDrawnAnew) {
  const struct {
    const char* name;
    std::function<void(Light&)> change;
    bool redraws_spot;
    bool redraws_point;
  } cases[] = {
      {"nothing", [](Light&) {}, false, false},
      {"position", [](Light& light) { light.position.y = 0.01F; }, true, true},
      {"range", [](Light& light) { light.range = 2.01F; }, true, true},
      {"direction", [](Light& light) { light.direction = {0.0F, -1.0F, 0.01F}; }, true, false},
      {"outer angle", [](Light& light) { light.outer_angle = 0.51F; }, true, false},
      {"inner angle", [](Light& light) { light.inner_angle = 0.1F; }, false, false},
      {"intensity", [](Light& light) { light.intensity = 7.0F; }, false, false},
      {"type", [](Light& light) { light.type = light.type == LightType::spot ? LightType::point : LightType::spot; },
       true, true},
  };
  for (const PointShadows points : {PointShadows::faces, PointShadows::octahedron})
    for (const auto& c : cases)
      for (const bool is_spot : {false, true}) {
        Light light = spot();
        if (!is_spot) light.type = LightType::point;
        LightsOfAnAtlas atlas({.light_capacity = 1, .points = points});
        EXPECT_EQ(atlas.schedule({light}).counts.redrawn, 1U);
        c.change(light);
        EXPECT_EQ(atlas.schedule({light}).counts.redrawn == 1, is_spot ? c.redraws_spot : c.redraws_point)
            << c.name << (is_spot ? " of a spot" : " of a point");
      }
}

/// A spot's square has another projection than a point's octahedron, be they as large.
TEST(ShadowSizes, ASpotThatBecomesAPointIsDrawnAnew) {
  LightsOfAnAtlas atlas({.light_capacity = 1, .points = PointShadows::octahedron, .texels_per_pixel = 1e6F});
  const ShadowFrame as_spot = atlas.schedule({spot()});
  const std::uint32_t side = as_spot.maps[0].side;
  const ShadowFrame as_point = atlas.schedule({{.range = 2.0F}});
  EXPECT_EQ(as_point.maps[0].side, side);
  EXPECT_EQ(as_point.maps[0].kind, shared::SHADOW_OCTAHEDRON);
}

/// An octahedron has all directions in a square, of which a face has a sixth.
TEST(ShadowSizes, OctahedraHaveTwiceTheSideOfOtherSquares) {
  const auto side = [](const Light& light, PointShadows points) {
    LightsOfAnAtlas atlas({.light_capacity = 1, .points = points});
    return atlas.schedule({light}).maps[0].side;
  };
  const Light point{.range = 2.0F};
  const std::uint32_t face = side(point, PointShadows::faces);
  EXPECT_GT(face, shared::LEAST_SQUARE);
  EXPECT_EQ(side(point, PointShadows::octahedron), 2 * face);
  EXPECT_EQ(side(spot(WIDEST_SPOT_SQUARE + 1e-4F), PointShadows::faces),
            2 * side(spot(WIDEST_SPOT_SQUARE), PointShadows::faces));
}

TEST(ShadowSizes, SomeLightsAreSmallerThanTheirShareOfThePicture) {
  const auto counts = [](std::uint32_t size, float texels_per_pixel) {
    LightsOfAnAtlas atlas({.size = size, .light_capacity = 1, .texels_per_pixel = texels_per_pixel});
    const ShadowFrame frame = atlas.schedule({spot()});
    EXPECT_EQ(frame.counts.shadowed, 1U);
    return std::pair(frame.maps[0].side, frame.counts.smaller);
  };
  EXPECT_EQ(counts(4096, 1.0F).second, 0U);
  EXPECT_EQ(counts(4096, 1e6F), std::pair(shared::MOST_SQUARE, 0U)) << "there are no larger ones";
  EXPECT_EQ(counts(256, 1e6F), std::pair(256U, 1U));
}

TEST(ShadowSizes, WhatIsDrawnForTheFirstTimeHasNotMoved) {
  LightsOfAnAtlas atlas({.light_capacity = 1});
  EXPECT_EQ(atlas.schedule({spot()}).counts.moved, 0U);
  const ShadowFrame near = atlas.schedule({spot()}, 5.0);
  EXPECT_EQ(near.counts.redrawn, 1U);
  EXPECT_EQ(near.counts.moved, 1U) << "to larger squares";
}

TEST(ShadowSizes, ABudgetIsUsedUpToItsLastTexel) {
  LightsOfAnAtlas atlas({.light_capacity = 1});
  const std::uint64_t texels = atlas.schedule({spot()}).counts.used_texels;
  LightsOfAnAtlas poor({.light_capacity = 1});
  EXPECT_EQ(poor.schedule({spot()}, 20.0, texels).counts.used_texels, texels);
  LightsOfAnAtlas poorer({.light_capacity = 1});
  EXPECT_EQ(poorer.schedule({spot()}, 20.0, texels - 1).counts.used_texels, texels / 4);
}

/// The map of what a light was before is none of its own.
TEST(ShadowSizes, ALightOfAnotherKindHasNoMapUntilItIsDrawn) {
  LightsOfAnAtlas atlas({.light_capacity = 1});
  EXPECT_EQ(atlas.schedule({{.range = 2.0F}}).maps[0].kind, shared::SHADOW_FACES);
  const ShadowFrame waits = atlas.schedule({spot()}, 20.0, 0);
  EXPECT_EQ(waits.maps[0].kind, shared::SHADOW_NONE);
  EXPECT_EQ(waits.counts.used_texels, 0U);
  EXPECT_EQ(waits.counts.without, 1U);
  EXPECT_EQ(atlas.schedule({spot()}).maps[0].kind, shared::SHADOW_SPOT);
}

/// The first has the whole atlas, and gives three quarters of it in the frame in which the other comes.
TEST(ShadowSizes, WhatAnotherGivesIsTakenInTheSameFrame) {
  LightsOfAnAtlas atlas({.size = 256, .light_capacity = 2, .texels_per_pixel = 1e6F});
  EXPECT_EQ(atlas.schedule({spot()}).maps[0].side, 256U);
  const ShadowFrame both = atlas.schedule({spot(), spot(0.4F)});
  EXPECT_EQ(both.counts.without, 0U);
  EXPECT_EQ(both.counts.no_room, 0U);
  EXPECT_EQ(both.maps[0].side, 128U);
  EXPECT_EQ(both.maps[1].side, 128U);
}

/// Squares that were taken apart come together again when all of them are given, at every level.
TEST(ShadowSizes, RoomComesTogetherAgain) {
  LightsOfAnAtlas atlas({.size = 256, .light_capacity = 256, .texels_per_pixel = 1e6F});
  EXPECT_EQ(atlas.schedule(std::vector<Light>(256, spot())).counts.used_texels, 256U * 256);
  EXPECT_EQ(atlas.schedule({}).counts.used_texels, 0U);
  EXPECT_EQ(atlas.schedule({spot()}).maps[0].side, 256U);
}

}  // namespace
}  // namespace lamp
