// Views and look-ups of shadow maps: what is drawn at a texel is what is looked up there.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"
#include "random.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::ShadowAtlasInfo;
using lamp::ShadowFilter;
using lamp::ShadowPlace;
using lamp::View;
namespace shared = lamp::shared;

constexpr std::uint32_t ATLAS = 1024;

/// Squares side by side from (16, 32) on.
shared::ShadowMap map_of(const shared::Light& light, const ShadowAtlasInfo& info, std::uint32_t side) {
  std::vector<lamp::UVec2> corners;
  for (std::uint32_t i = 0; i < lamp::shadow_squares(light, info.points); ++i) corners.emplace_back(16 + i * side, 32U);
  return lamp::shadow_map(light, info, side, corners);
}

glm::dvec3 clip_of(const shared::ShadowView& view, const glm::dvec3& rel) {
  return {glm::dot(glm::dvec3(glm::vec3(view.row_x)), rel), glm::dot(glm::dvec3(glm::vec3(view.row_y)), rel),
          glm::dot(glm::dvec3(glm::vec3(view.row_w)), rel)};
}

/// A viewport of its own draws a view where the whole atlas as viewport does, and nothing that planes would clip.
void expect_same_in_viewport(const shared::ShadowMap& map, const shared::ShadowView& view, const glm::dvec3& rel) {
  const lamp::ShadowSquare viewport = lamp::shadow_viewport(map, view);
  const glm::dvec3 clip = clip_of(view, rel);
  const glm::dvec3 own = clip_of(lamp::shadow_view_in(view, viewport, ATLAS), rel);
  EXPECT_EQ(own.z, clip.z);
  if (!(clip.z > 0.01)) return;
  const glm::dvec2 texel = (glm::dvec2(clip) / clip.z + 1.0) * (ATLAS * 0.5);
  const glm::dvec2 own_texel =
      glm::dvec2(viewport.corner.x, viewport.corner.y) + (glm::dvec2(own) / own.z + 1.0) * (viewport.side * 0.5);
  const double steep = 1.0 + glm::length(texel) / ATLAS;  // far outside of it numbers are large
  EXPECT_LE(glm::distance(texel, own_texel), 1e-3 * steep);
  const bool octant = map.kind == shared::SHADOW_OCTAHEDRON;
  bool drawn = std::max(std::abs(own.x), std::abs(own.y)) < 0.999 * own.z;
  drawn = drawn && (!octant || glm::dot(glm::dvec3(glm::vec3(view.planes[2])), rel) > 1e-3);
  for (const glm::vec3 plane : view.planes) EXPECT_TRUE(!drawn || glm::dot(glm::dvec3(plane), rel) > 0.0);
}

/// How many views draw a point, and that each draws it where the look-up finds it.
int drawn_at(const shared::ShadowMap& map, const glm::vec3& point) {
  std::vector<shared::ShadowView> views;
  lamp::add_shadow_views(map, ATLAS, 5, views);
  const ShadowPlace place = lamp::shadow_place(map, point);
  int drawn = 0;
  for (const shared::ShadowView& view : views) {
    EXPECT_EQ(view.light, 5U);
    const glm::dvec3 rel = glm::dvec3(point) - glm::dvec3(view.position);
    expect_same_in_viewport(map, view, rel);
    bool inside = true;
    for (const glm::vec3 plane : view.planes) inside = inside && glm::dot(glm::dvec3(plane), rel) >= 0.0;
    if (!inside) continue;
    const double w = glm::dot(glm::dvec3(view.row_w), rel);
    const glm::dvec2 texel =
        (glm::dvec2(glm::dot(glm::dvec3(view.row_x), rel), glm::dot(glm::dvec3(view.row_y), rel)) / w + 1.0) *
        (ATLAS * 0.5);
    const glm::dvec2 off = glm::abs(texel - glm::dvec2(place.texel));
    // Beside a face or an octant, what its border shows lies elsewhere.
    if (map.kind == shared::SHADOW_FACES && view.view != place.square) continue;
    if (map.kind == shared::SHADOW_OCTAHEDRON && (std::max(off.x, off.y) > 2e-3 || w < double{place.w} * 0.99999)) {
      // Octants overlap by 0.02 texels: inwards, or off the square's edge, where no texel is.
      const glm::dvec2 from_middle = glm::abs(texel - glm::dvec2(16.0, 32.0) - map.side * 0.5);
      const double beyond = std::max(from_middle.x, from_middle.y) - map.side * 0.5;
      EXPECT_TRUE(std::max(off.x, off.y) <= 0.1 || (beyond > 0.0 && beyond < 0.1));
      continue;
    }
    ++drawn;
    EXPECT_LE(std::max(off.x, off.y), 2e-3);
    EXPECT_NEAR(w / double{place.w}, 1.0, 1e-5);
    EXPECT_GT(w, 0.0);
  }
  return drawn;
}

TEST(ShadowViews, DrawWhereTheLookUpLooks) {
  lamp::test::Random random(1);
  for (const lamp::PointShadows points : {lamp::PointShadows::faces, lamp::PointShadows::octahedron}) {
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm}) {
      const ShadowAtlasInfo info{.size = ATLAS, .points = points, .filter = filter};
      for (const std::uint32_t side : {16U, 32U, 64U, 128U}) {
        const shared::Light light = lamp::pack(Light{.position = random.vector(50.0F), .range = 10.0F});
        const shared::ShadowMap map = map_of(light, info, side);
        for (int i = 0; i < 300; ++i) {
          const glm::vec3 point = glm::vec3(light.position) + random.direction() * random.in(0.01F, 10.0F);
          ASSERT_GE(drawn_at(map, point), 1);
        }
      }
    }
  }
}

TEST(ShadowViews, SpotsDrawAllOfTheirCone) {
  lamp::test::Random random(1);
  for (int round = 0; round < 60; ++round) {
    const float half_angle = random.in(0.01F, std::numbers::pi_v<float> / 2.0F);
    const shared::Light light = lamp::pack(Light{.type = LightType::spot,
                                                 .position = random.vector(10.0F),
                                                 .range = 10.0F,
                                                 .direction = random.direction(),
                                                 .outer_angle = half_angle});
    const ShadowAtlasInfo info{.size = ATLAS, .filter = ShadowFilter::pcf};
    const shared::ShadowMap map = map_of(light, info, 64);
    EXPECT_EQ(map.kind, half_angle > lamp::WIDEST_SPOT_SQUARE ? shared::SHADOW_OCTAHEDRON : shared::SHADOW_SPOT);
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 aside = glm::normalize(glm::cross(glm::vec3(light.direction), random.direction()));
      const float angle = half_angle * random.in(0.0F, 0.9999F);
      const glm::vec3 way = std::cos(angle) * glm::vec3(light.direction) + std::sin(angle) * aside;
      const glm::vec3 point = glm::vec3(light.position) + way * random.in(0.1F, 10.0F);
      ASSERT_GE(drawn_at(map, point), 1) << half_angle << " " << angle;
      const glm::vec2 in_square = glm::vec2(lamp::shadow_place(map, point).texel) - glm::vec2(16.0F, 32.0F);
      if (map.kind != shared::SHADOW_SPOT) continue;
      const float border = static_cast<float>(lamp::shadow_border(info.filter, 64)) - 0.01F;
      EXPECT_TRUE(in_square.x >= border && in_square.y >= border && in_square.x <= 64.0F - border &&
                  in_square.y <= 64.0F - border);
    }
  }
}

TEST(ShadowViews, FacesHaveTheirBorder) {
  lamp::test::Random random(1);
  for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm, ShadowFilter::evsm}) {
    for (std::uint32_t side = 16; side <= 512; side *= 2) {
      const auto border = static_cast<float>(lamp::shadow_border(filter, side));
      ASSERT_LT(2.0F * border, static_cast<float>(side));
      const shared::Light light = lamp::pack(Light{.range = 10.0F});
      const shared::ShadowMap map = map_of(light, {.size = 4096, .filter = filter}, side);
      for (int i = 0; i < 100; ++i) {
        const ShadowPlace place = lamp::shadow_place(map, random.direction());
        const glm::vec2 in_square =
            glm::vec2(place.texel) - glm::vec2(16.0F + static_cast<float>(place.square * side), 32.0F);
        EXPECT_GE(std::min(in_square.x, in_square.y), border - 0.001F);
        EXPECT_LE(std::max(in_square.x, in_square.y), static_cast<float>(side) - border + 0.001F);
      }
    }
  }
}

/// One more than the farthest texel that a filter asks for.
TEST(ShadowViews, BordersHoldWhatFiltersAskFor) {
  const auto borders = [](ShadowFilter filter) {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t side : {16U, 32U, 64U, 2048U}) found.push_back(lamp::shadow_border(filter, side));
    return found;
  };
  EXPECT_EQ(borders(ShadowFilter::hard), (std::vector<std::uint32_t>{1, 1, 1, 1}));
  EXPECT_EQ(borders(ShadowFilter::pcf), (std::vector<std::uint32_t>{2, 2, 3, 3}));
  EXPECT_EQ(borders(ShadowFilter::vsm), (std::vector<std::uint32_t>{1, 5, 13, 13}));
  EXPECT_EQ(borders(ShadowFilter::evsm), borders(ShadowFilter::vsm));
}

TEST(ShadowViews, AMapShowsAllOfALightThatHasNotGrown) {
  const Light spot{.type = LightType::spot, .range = 10.0F, .direction = {0.0F, -1.0F, 0.0F}, .outer_angle = 0.5F};
  const ShadowAtlasInfo info{.filter = ShadowFilter::hard};
  for (const Light& drawn : {spot, Light{.range = 10.0F}}) {
    const bool is_spot = drawn.type == LightType::spot;
    const shared::ShadowMap map = map_of(lamp::pack(drawn), info, 64);
    const auto shows = [&](const auto& change) {
      Light light = drawn;
      change(light);
      return lamp::shadow_shows_all(map, lamp::pack(light));
    };
    EXPECT_TRUE(shows([](Light&) {}));
    EXPECT_TRUE(shows([](Light& light) { light.range = 9.0F; }));
    EXPECT_FALSE(shows([](Light& light) { light.range = 10.1F; }));
    EXPECT_FALSE(shows([](Light& light) { light.position.x = 0.1F; }));
    EXPECT_EQ(shows([](Light& light) { light.direction = {0.0F, -1.0F, 0.1F}; }), !is_spot);
    EXPECT_TRUE(shows([](Light& light) { light.outer_angle = 0.4F; }));
    EXPECT_EQ(shows([](Light& light) { light.outer_angle = 0.6F; }), !is_spot);
    EXPECT_EQ(shows([](Light& light) { light.type = LightType::point; }), !is_spot);
  }
  EXPECT_FALSE(lamp::shadow_shows_all({}, lamp::pack(spot)));
}

TEST(ShadowViews, ALightSeesNothingAtItsOwnPlace) {
  const shared::Light light = lamp::pack(Light{.position = {1.0F, 2.0F, 3.0F}, .range = 10.0F});
  EXPECT_EQ(lamp::shadow_place(map_of(light, {}, 64), light.position).w, 0.0F);
  EXPECT_EQ(lamp::shadow_place({}, light.position).w, 0.0F);
  const shared::Light spot = lamp::pack(Light{.type = LightType::spot, .range = 10.0F});
  EXPECT_FALSE(lamp::shadow_place(map_of(spot, {}, 64), {0.0F, 0.0F, 1.0F}).w > 0.0F) << "behind it";
}

std::vector<View> views_of_all_kinds() {
  const glm::dmat4 from = glm::lookAt(glm::dvec3(3.0, 2.0, 9.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
  return {View::create(640, 360, lamp::perspective(lamp::symmetric_window(1.0, 16.0 / 9.0), 0.05, 100.0), from).value(),
          View::create(640, 360, lamp::perspective({-0.2, 1.4, -0.9, 0.1}, 0.05, lamp::INFINITE_FAR), from).value(),
          View::create(640, 360, lamp::orthographic({-4.0, 5.0, -3.0, 2.0}, 0.0, 100.0), from).value()};
}

TEST(ShadowViews, WhatIsInThePictureIsSeen) {
  lamp::test::Random random(1);
  for (const View& view : views_of_all_kinds()) {
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 point =
          view.view_position({random.in(0.0F, 640.0F), random.in(0.0F, 360.0F)}, random.in(0.05F, 60.0F));
      const glm::vec3 world(glm::dmat4(view.world_from_view()) * glm::dvec4(point, 1.0));
      const float radius = std::exp(random.in(-4.0F, 4.0F));
      const shared::LightSphere sphere{.center = world + random.direction() * (radius * 0.999F), .radius = radius};
      const double shown = lamp::shown_diameter_px(view, sphere);
      ASSERT_GT(shown, 0.0);
      ASSERT_LE(shown, 640.0);
    }
  }
}

TEST(ShadowViews, SizesDoNotHangOnHowACameraIsWritten) {
  lamp::test::Random random(2);
  const glm::dvec3 step(0.0, 0.0, 5.0);  // of the eye, out of view space's origin
  for (const View& view : views_of_all_kinds()) {
    const glm::dmat4 clip = view.clip_from_view();
    const glm::dmat4 from_world = view.view_from_world();
    const View scaled = View::create(640, 360, 4.0 * clip, from_world).value();
    const View moved = View::create(640, 360, clip * glm::translate(glm::dmat4(1.0), -step),
                                    glm::translate(glm::dmat4(1.0), step) * from_world)
                           .value();
    for (int i = 0; i < 500; ++i) {
      const shared::LightSphere sphere{.center = random.vector(20.0F), .radius = random.in(0.1F, 4.0F)};
      const double shown = lamp::shown_diameter_px(view, sphere);
      EXPECT_NEAR(lamp::shown_diameter_px(scaled, sphere), shown, 1e-2);
      EXPECT_NEAR(lamp::shown_diameter_px(moved, sphere), shown, 1e-2);
    }
  }
}

TEST(ShadowViews, SizesAreOfTheSideThatShowsMore) {
  for (const lamp::Window& window : {lamp::Window{-1.0, 1.0, -1.0, 1.0}, lamp::Window{-2.0, 2.0, -0.5, 0.5}}) {
    const double px = std::max(640.0 / (window.right - window.left), 360.0 / (window.top - window.bottom));
    const glm::dmat4 here(1.0);
    const View near = View::create(640, 360, lamp::perspective(window, 0.05, 100.0), here).value();
    const View flat = View::create(640, 360, lamp::orthographic(window, 0.0, 100.0), here).value();
    EXPECT_NEAR(lamp::shown_diameter_px(near, {.center = {0, 0, -10}, .radius = 0.5F}), px / 10.0, 0.01 * px / 10.0);
    EXPECT_NEAR(lamp::shown_diameter_px(flat, {.center = {0, 0, -10}, .radius = 0.1F}), px * 0.2, 1e-2);
  }
}

TEST(ShadowViews, WhatIsBesideOrBehindIsNotSeen) {
  for (const View& view : views_of_all_kinds()) {
    const auto seen = [&](const glm::dvec3& at, float radius) {
      const glm::vec3 world(glm::dmat4(view.world_from_view()) * glm::dvec4(at, 1.0));
      return lamp::shown_diameter_px(view, {.center = world, .radius = radius});
    };
    EXPECT_EQ(seen({100.0, 0.0, -10.0}, 5.0F), 0.0);
    EXPECT_EQ(seen({0.0, -100.0, -10.0}, 5.0F), 0.0);
    EXPECT_EQ(seen({0.0, 0.0, -10.0}, -1.0F), 0.0) << "a sphere of nothing";
    EXPECT_EQ(seen({0.0, 0.0, -10.0}, std::numeric_limits<float>::infinity()), 640.0);
    EXPECT_EQ(seen({0.0, 0.0, 10.0}, 5.0F) == 0.0, !view.orthographic()) << "behind the eye";
    EXPECT_GT(seen({0.0, 0.0, 1.0}, 1.5F), 0.0) << "it reaches ahead of the eye";
    EXPECT_EQ(seen({0.0, 0.0, -0.5}, 5.0F), view.orthographic() ? std::min(640.0, 10.0 * 360.0 / 5.0) : 640.0);
  }
}

}  // namespace
