// Generated lights: they stay in the air of a room, the counts and fractions hold, paths close, nothing is random.
// SPDX-License-Identifier: Apache-2.0
#include "scene/place_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "error.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::app::Box;
using lamp::app::place_lights;
using lamp::app::PlaceLights;
using lamp::app::Scene;

const Box ROOM{{-5, 0, -4}, {5, 4, 4}};
const Box PILLAR{{1, 0, -1}, {2.5F, 4, 1}};
const Box TOWER{{14, -1, -3}, {18, 9, 3}};  // far outside the room, so that there is air outside

enum class Facing : std::uint8_t { outwards, inwards };

// The twelve triangles of a box, or all but those of its top.
void add_box(Scene& scene, const Box& box, Facing facing, bool top = true) {
  const auto base = static_cast<std::uint32_t>(scene.vertices.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    scene.vertices.push_back({.position = {(i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                                           (i & 4U) != 0 ? box.max.z : box.min.z}});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> FACES{
      {{2, 6, 7, 3}, {0, 1, 5, 4}, {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (std::size_t i = top ? 0 : 1; i < FACES.size(); ++i) {
    std::array<std::uint32_t, 4> f = FACES[i];
    if (facing == Facing::inwards) std::ranges::reverse(f);
    for (const std::uint32_t corner : {f[0], f[1], f[2], f[0], f[2], f[3]}) scene.indices.push_back(base + corner);
  }
}

void finish(Scene& scene, const glm::mat4& pose = glm::mat4(1.0F)) {
  scene.materials.resize(1);
  scene.meshes = {{.index_count = static_cast<std::uint32_t>(scene.indices.size())}};
  scene.instances = {{.world_from_object = pose}};
}

void add_camera(Scene& scene, const glm::vec3& eye, const glm::vec3& target) {
  const glm::mat4 camera_from_world = glm::lookAt(eye, target, glm::vec3(0, 1, 0));
  scene.cameras.push_back({.name = "test", .world_from_camera = glm::inverse(camera_from_world)});
}

Scene closed_room(const glm::mat4& pose = glm::mat4(1.0F)) {
  Scene scene;
  add_box(scene, ROOM, Facing::inwards);
  add_box(scene, {ROOM.min - 1.0F, ROOM.max + 1.0F}, Facing::outwards);
  add_box(scene, PILLAR, Facing::outwards);
  add_box(scene, TOWER, Facing::outwards);
  finish(scene, pose);
  add_camera(scene, glm::vec3(pose * glm::vec4(-3, 2, 0, 1)), glm::vec3(pose * glm::vec4(5, 2, 0, 1)));
  return scene;
}

bool inside(const Box& box, const glm::vec3& p) {
  return glm::all(glm::greaterThan(p, box.min)) && glm::all(glm::lessThan(p, box.max));
}

void expect_all_in_the_room(const Scene& scene, const glm::mat4& pose) {
  const auto air = lamp::app::find_open_air(scene);
  for (const std::uint32_t frame : {0U, 1U, 37U, 75U, 150U, 299U}) {
    const auto lights = place_lights(air, {.count = 3000, .min_range = 4.0F, .max_range = 8.0F, .frame = frame});
    for (const Light& light : lights) {
      const glm::vec3 p(glm::inverse(pose) * glm::vec4(glm::vec3(light.position), 1.0F));
      ASSERT_TRUE(inside(ROOM, p)) << "(" << p.x << ", " << p.y << ", " << p.z << ")";
      ASSERT_FALSE(inside(PILLAR, p)) << "(" << p.x << ", " << p.y << ", " << p.z << ")";
    }
  }
}

TEST(PlaceLights, StayInTheAirOfAClosedRoomOnAllOfTheirPath) {
  expect_all_in_the_room(closed_room(), glm::mat4(1.0F));
  for (const float angle : {0.4F, 1.1F, 2.0F}) {
    const glm::mat4 pose = glm::rotate(glm::mat4(1.0F), angle, glm::normalize(glm::vec3(1, 2, -3)));
    expect_all_in_the_room(closed_room(pose), pose);
  }
}

TEST(PlaceLights, WindingAndDoubleSidedMaterialsDoNotMatterInAClosedRoom) {
  Scene scene = closed_room();
  for (std::size_t i = 0; i < scene.indices.size(); i += 3) std::swap(scene.indices[i], scene.indices[i + 1]);
  expect_all_in_the_room(scene, glm::mat4(1.0F));
  scene.materials[0].double_sided = true;
  expect_all_in_the_room(scene, glm::mat4(1.0F));
  const glm::mat4 mirror = glm::scale(glm::mat4(1.0F), glm::vec3(-1, 1, 1));
  expect_all_in_the_room(closed_room(mirror), mirror);
}

// Lights outside of any of the boxes.
int count_outside(const std::vector<Light>& lights, const std::vector<Box>& boxes) {
  return static_cast<int>(std::ranges::count_if(lights, [&](const Light& light) {
    return std::ranges::none_of(boxes, [&](const Box& box) { return inside(box, light.position); });
  }));
}

TEST(PlaceLights, BehindTheWallsOfARoofLessYardIsNoAir) {
  const Box far_away{{60, 0, 0}, {61, 10, 1}};
  for (const float handedness : {1.0F, -1.0F}) {
    Scene scene;
    add_box(scene, {{-20, 0, -20}, {20, 8, 20}}, Facing::inwards, /* top= */ false);
    add_box(scene, far_away, Facing::outwards);
    if (handedness < 0.0F)  // as the glTF loader turns triangles round that are placed mirrored
      for (std::size_t i = 0; i < scene.indices.size(); i += 3) std::swap(scene.indices[i], scene.indices[i + 1]);
    finish(scene, glm::scale(glm::mat4(1.0F), glm::vec3(handedness, 1, 1)));
    add_camera(scene, {0, 2, 0}, {5, 2, 0});
    const auto lights = place_lights(scene, {.count = 1000, .min_range = 1.0F, .max_range = 1.0F});
    const Box yard_and_sky{{-21, 0, -21}, {21, 30, 21}};
    const Box around_far_away{{far_away.min - 10.0F}, {far_away.max + 10.0F}};
    const Box mirrored{{-71, -10, -10}, {-50, 20, 11}};
    EXPECT_LT(count_outside(lights, {yard_and_sky, handedness > 0.0F ? around_far_away : mirrored}), 20);
  }
}

TEST(PlaceLights, ClosedDoorsDoNotHideTheRestOfALevel) {
  Scene scene;
  std::vector<Box> rooms;
  for (int i = 0; i < 16; ++i) {
    const int row = i / 4;
    const glm::vec3 corner(12.0F * static_cast<float>(i % 4), 0.0F, 12.0F * static_cast<float>(row));
    rooms.push_back({corner, corner + glm::vec3(8, 4, 8)});
    add_box(scene, rooms.back(), Facing::inwards);
  }
  finish(scene);
  add_camera(scene, {2, 2, 2}, {5, 2, 5});
  const auto lights = place_lights(scene, {.count = 1000, .min_range = 1.0F, .max_range = 1.0F});
  EXPECT_LT(count_outside(lights, rooms), 20);
  EXPECT_GT(count_outside(lights, {rooms[0]}), 800);
}

TEST(PlaceLights, FillTheRoomEvenly) {
  const auto lights = place_lights(closed_room(), {.count = 4000, .min_range = 1.0F, .max_range = 2.0F});
  int left = 0;
  int low = 0;
  for (const Light& light : lights) {
    left += light.position.x < -2.0F ? 1 : 0;
    low += light.position.y < 2.0F ? 1 : 0;
  }
  EXPECT_NEAR(left, 4000 * 0.3 / 0.9625, 250);  // the pillar takes 3.75% of the room
  EXPECT_NEAR(low, 2000, 250);
}

TEST(PlaceLights, CameraInAWallFindsTheAirItLooksAt) {
  Scene scene = closed_room();
  scene.cameras.clear();
  add_camera(scene, {-5, 2, 0}, {5, 2, 0});
  expect_all_in_the_room(scene, glm::mat4(1.0F));
}

TEST(PlaceLights, FlightsCountAsCameras) {
  Scene scene = closed_room();
  scene.cameras.clear();
  scene.flight = lamp::app::Flight{.keys = {{.eye = {-3, 2, 0}, .target = {0, 2, 0}}}};
  expect_all_in_the_room(scene, glm::mat4(1.0F));
}

TEST(PlaceLights, CameraInAClosetDoesNotHideTheScene) {
  const Box hall{{0, 0, 0}, {40, 12, 30}};
  const Box closet{{20, 0, 10}, {21.2F, 1.2F, 11.2F}};
  Scene scene;
  add_box(scene, hall, Facing::inwards);
  add_box(scene, closet, Facing::inwards);
  finish(scene);
  add_camera(scene, {20.6F, 0.6F, 10.6F}, {20.6F, 0.7F, 11.0F});
  EXPECT_GT(count_outside(place_lights(scene, {.count = 1000}), {closet}), 900);
}

TEST(PlaceLights, StayNearSurfacesUnderAnOpenSky) {
  const Box ground{{-50, -1, -50}, {50, 0, 50}};
  const Box mast{{-1, 0, -1}, {1, 60, 1}};
  Scene scene;
  add_box(scene, ground, Facing::outwards);
  add_box(scene, mast, Facing::outwards);
  finish(scene);
  add_camera(scene, {20, 2, 20}, {0, 2, 0});
  int high = 0;
  for (const Light& light : place_lights(scene, {.count = 2000, .min_range = 1.0F, .max_range = 1.0F})) {
    const glm::vec3 p = light.position;
    EXPECT_GT(p.y, 0.0F);
    const float to_mast = std::max({std::abs(p.x) - 1.0F, std::abs(p.z) - 1.0F, p.y - 60.0F});
    EXPECT_LT(std::min(p.y, to_mast), 12.5F);
    high += p.y > 15.0F ? 1 : 0;
  }
  EXPECT_GT(high, 20);
  EXPECT_LT(high, 500);
}

TEST(PlaceLights, SpotFraction) {
  const Scene scene = closed_room();
  const auto spots = [&](float fraction) {
    const auto lights = place_lights(scene, {.count = 2000, .spots = fraction});
    EXPECT_EQ(lights.size(), 2000U);
    return std::ranges::count(lights, LightType::spot, &Light::type);
  };
  EXPECT_EQ(spots(0.0F), 0);
  EXPECT_EQ(spots(1.0F), 2000);
  EXPECT_NEAR(static_cast<double>(spots(0.3F)), 600.0, 90.0);
}

TEST(PlaceLights, AreNoBrighterThanLightsMayBe) {
  for (const Light& light : place_lights(closed_room(), {.count = 3, .min_range = 3e15F, .max_range = 3e15F}))
    EXPECT_EQ(light.intensity, lamp::app::LARGEST_INTENSITY);
}

TEST(PlaceLights, AreValidAndWithinTheStatedNumbers) {
  const auto lights = place_lights(closed_room(), {.count = 2000, .min_range = 0.5F, .max_range = 4.0F, .seed = 9});
  const auto error = lamp::check_lights(lights);
  EXPECT_FALSE(error.has_value()) << error->text();
  int short_ranges = 0;
  int down = 0;
  for (const Light& light : lights) {
    EXPECT_GE(light.range, 0.5F);
    EXPECT_LE(light.range, 4.0F);
    EXPECT_GE(light.outer_angle, 0.2617F);
    EXPECT_LE(light.outer_angle, 0.7855F);
    EXPECT_GE(light.inner_angle, 0.59F * light.outer_angle);
    EXPECT_LE(light.inner_angle, 0.91F * light.outer_angle);
    EXPECT_NEAR(glm::length(glm::vec3(light.direction)), 1.0F, 1e-5F);
    EXPECT_FLOAT_EQ(light.intensity, light.range * light.range);
    short_ranges += light.range < std::sqrt(2.0F) ? 1 : 0;
    down += light.direction.y < 0.0F ? 1 : 0;
  }
  EXPECT_NEAR(short_ranges, 1000, 120) << "ranges must be log-uniform";
  EXPECT_NEAR(down, 1700, 120);
}

bool same(const Light& a, const Light& b) {
  return a.type == b.type && a.position == b.position && a.range == b.range && a.color == b.color &&
         a.intensity == b.intensity && a.direction == b.direction && a.inner_angle == b.inner_angle &&
         a.outer_angle == b.outer_angle;
}

TEST(PlaceLights, SameInputSameLights) {
  const Scene scene = closed_room();
  const auto a = place_lights(scene, {.count = 500, .seed = 3, .frame = 11});
  const auto b = place_lights(scene, {.count = 500, .seed = 3, .frame = 11});
  const auto other_seed = place_lights(scene, {.count = 500, .seed = 4, .frame = 11});
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(same(a[i], b[i]));
    ASSERT_NE(a[i].position, other_seed[i].position);
  }
}

TEST(PlaceLights, ALightDoesNotDependOnTheOthers) {
  const Scene scene = closed_room();
  const auto few = place_lights(scene, {.count = 10, .min_range = 1.0F, .max_range = 2.0F});
  const auto many = place_lights(scene, {.count = 1000, .min_range = 1.0F, .max_range = 2.0F});
  for (std::size_t i = 0; i < few.size(); ++i) ASSERT_TRUE(same(few[i], many[i])) << i;
}

TEST(PlaceLights, SpotFractionMovesNoLight) {
  const Scene scene = closed_room();
  const auto points = place_lights(scene, {.count = 100, .spots = 0.0F});
  const auto spots = place_lights(scene, {.count = 100, .spots = 1.0F});
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].position, spots[i].position);
}

TEST(PlaceLights, PathsAreSmoothAndClosed) {
  const auto air = lamp::app::find_open_air(closed_room());
  PlaceLights how{.count = 200, .min_range = 1.0F, .max_range = 2.0F, .frames = 120};
  const auto start = place_lights(air, how);
  auto previous = start;
  std::vector<float> path(how.count, 0.0F);
  for (how.frame = 1; how.frame <= how.frames; ++how.frame) {
    const auto lights = place_lights(air, how);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const float step = glm::distance(glm::vec3(lights[i].position), glm::vec3(previous[i].position));
      // Three waves a path, half the range high, along three axes.
      ASSERT_LT(step, 1.01F * 6.2832F * 3.0F / 120.0F * 0.5F * lights[i].range * 1.7321F);
      path[i] += step;
    }
    previous = lights;
  }
  int moving = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    ASSERT_TRUE(same(start[i], previous[i]));
    moving += path[i] > 0.1F ? 1 : 0;
  }
  EXPECT_GT(moving, 180);
}

TEST(PlaceLights, WithoutRangeTheyAreTheSameLightsOtherwise) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Scene scene = closed_room();
  const auto with = place_lights(scene, {.count = 50});
  auto without = place_lights(scene, {.count = 50, .min_range = infinity, .max_range = infinity});
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(without[i].range, infinity);
    without[i].range = with[i].range;
    EXPECT_TRUE(same(with[i], without[i]));
  }
}

// The mean number of lights whose range holds the middle of a cell of air.
double overlap(const Scene& scene, std::uint32_t count) {
  const auto air = lamp::app::find_open_air(scene);
  const auto lights = place_lights(air, {.count = count});
  double sum = 0.0;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < air.cells.size(); i += 997) {
    const glm::vec3 p = air.cells[i].min + 0.5F * air.cell_m;
    for (const Light& light : lights) sum += glm::distance(glm::vec3(light.position), p) < light.range ? 1.0 : 0.0;
    ++samples;
  }
  return sum / static_cast<double>(samples);
}

TEST(PlaceLights, AutomaticRangesOverlapAboutTwentyFourTimes) {
  const Scene scene = closed_room();
  // Less than 24, because ranges near the walls reach into them; the less, the shorter the ranges are.
  EXPECT_GT(overlap(scene, 500), 12.0);
  EXPECT_GT(overlap(scene, 20000), 18.0);
  EXPECT_LT(overlap(scene, 20000), 26.0);
}

TEST(PlaceLights, AutomaticRangesKeepTheLightAndTheDiagonal) {
  const Scene scene = closed_room();
  const Box box = lamp::app::bounds(scene);
  EXPECT_LE(place_lights(scene, {.count = 1})[0].range, glm::length(box.max - box.min));
  // A light's contribution, averaged over the air, goes with intensity times range.
  const auto total = [&](std::uint32_t count) {
    double sum = 0.0;
    for (const Light& light : place_lights(scene, {.count = count})) sum += double{light.intensity} * light.range;
    return sum;
  };
  EXPECT_NEAR(total(500) / total(20000), 1.0, 0.1);
}

TEST(PlaceLights, EmptySceneAndNoLights) {
  EXPECT_EQ(place_lights(Scene{}, {.count = 100}).size(), 100U);
  EXPECT_TRUE(place_lights(closed_room(), {.count = 0}).empty());
}

TEST(PlaceLights, RefusesWhatMakesNoSense) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<PlaceLights> bad{{.spots = -0.1F},
                                     {.spots = 1.1F},
                                     {.spots = nan},
                                     {.min_range = -1.0F, .max_range = 2.0F},
                                     {.min_range = 0.0F, .max_range = 2.0F},
                                     {.min_range = 3.0F, .max_range = 2.0F},
                                     {.min_range = 1.0F, .max_range = infinity},
                                     {.min_range = nan, .max_range = nan},
                                     {.frames = 0}};
  for (std::size_t i = 0; i < bad.size(); ++i) {
    EXPECT_THROW(static_cast<void>(place_lights(Scene{}, bad[i])), lamp::app::Error) << i;
  }
}

}  // namespace
