// Decals of scenes, their own and generated ones: on surfaces, the same for the same seed, independent of each other.
// SPDX-License-Identifier: Apache-2.0
#include "scene/place_decals.h"

#include <gtest/gtest.h>

#include "error.h"
#include "lamplight/entity.h"
#include "render/decal_pass.h"
#include "scene/builtin.h"

namespace lamp::app {
namespace {

Scene atrium() {
  for (const BuiltinScene& scene : builtin_scenes())
    if (scene.name == "atrium") return scene.make();
  throw Error("no atrium");
}

bool same(const Decal& a, const Decal& b) {
  return a.center == b.center && a.orientation == b.orientation && a.half_extents == b.half_extents &&
         a.pattern == b.pattern && a.color_a == b.color_a && a.seed == b.seed;
}

TEST(PlaceDecals, EverySceneTakesThem) {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    SCOPED_TRACE(builtin.name);
    const Scene scene = builtin.make();
    const std::vector<Decal> decals = place_decals(scene, 300, 1);
    ASSERT_EQ(decals.size(), 300U);
    EXPECT_FALSE(check_boxes(boxes_of(pack(decals))).has_value());
    const Box box = bounds(scene);
    for (const Decal& decal : decals) {
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(decal.center, box.min - 0.01F)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(decal.center, box.max + 0.01F)));
      EXPECT_LT(decal.full_angle, decal.none_angle);
    }
  }
}

TEST(PlaceDecals, TheScenesOwnComeFirst) {
  const Scene scene = atrium();
  ASSERT_GE(scene.decals.size(), 40U);
  const auto own = static_cast<std::uint32_t>(scene.decals.size());
  const std::vector<Decal> few = place_decals(scene, 5, 1);
  const std::vector<Decal> many = place_decals(scene, own + 10, 1);
  const std::vector<Decal> more = place_decals(scene, own + 20, 1);
  const std::vector<Decal> other = place_decals(scene, own + 10, 2);
  ASSERT_EQ(few.size(), 5U);
  ASSERT_EQ(more.size(), own + 20);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(same(few[i], scene.decals[i]));
  for (std::size_t i = 0; i < own; ++i) EXPECT_TRUE(same(many[i], scene.decals[i]));
  for (std::size_t i = own; i < many.size(); ++i) {
    EXPECT_TRUE(same(many[i], more[i])) << "decal " << i << " depends on how many are asked for";
    EXPECT_FALSE(same(many[i], other[i])) << "the seed changes nothing";
  }
  EXPECT_TRUE(place_decals(scene, 0, 1).empty());
}

TEST(PlaceDecals, NeedsASurface) {
  Scene scene;
  scene.name = "void";
  EXPECT_TRUE(place_decals(scene, 0, 1).empty());
  EXPECT_THROW((void)place_decals(scene, 1, 1), Error);
}

}  // namespace
}  // namespace lamp::app
