// The adversarial scenes' lights are what their names say, at every count.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scene/builtin.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::View;
using lamp::app::builtin_scenes;
using lamp::app::BuiltinScene;
using lamp::app::OpenAir;
using lamp::app::place_lights;
using lamp::app::Scene;

constexpr std::uint32_t COUNTS[] = {1, 64, 1024, 65536};

struct Place {
  Scene scene;
  OpenAir air;
};

const Place& place(std::string_view name) {
  static std::map<std::string_view, Place> places;
  if (const auto found = places.find(name); found != places.end()) return found->second;
  const auto row = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  Place made{.scene = row->make(), .air = {}};
  made.air = find_open_air(made.scene);
  return places.emplace(row->name, std::move(made)).first->second;
}

View first_view(const Scene& scene, std::uint32_t width, std::uint32_t height) {
  return view_of(scene.cameras.front(), width, height, "camera");
}

TEST(AdversarialScenes, AreMarkedAndMakeSoundLights) {
  int count = 0;
  for (const BuiltinScene& row : builtin_scenes()) {
    if (!row.adversarial) continue;
    ++count;
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(row.summary.starts_with("adversarial: ")) << row.summary;
    EXPECT_TRUE(place_lights(place(row.name).air, {.count = 0}).empty());
    for (const std::uint32_t n : COUNTS) {
      const std::vector<Light> lights = place_lights(place(row.name).air, {.count = n, .frame = 7});
      ASSERT_EQ(lights.size(), n);
      EXPECT_FALSE(lamp::check_lights(lights).has_value());
      const std::vector<Light> later = place_lights(place(row.name).air, {.count = n, .frame = 57});
      EXPECT_NE(lights.front().position, later.front().position) << "stands still";
    }
  }
  EXPECT_EQ(count, 6);
}

// The square around a light's projection, generously: its range seen at its nearest point.
TEST(AdversarialScenes, OneTileIsOneTile) {
  const Place& hall = place("one-tile");
  for (const auto& [width, height] : {std::pair(1920U, 1080U), std::pair(3840U, 2160U)}) {
    const View view = first_view(hall.scene, width, height);
    for (const std::uint32_t n : COUNTS) {
      glm::dvec2 low(1e9);
      glm::dvec2 high(-1e9);
      for (const Light& light : place_lights(hall.air, {.count = n, .frame = 30})) {
        const glm::dvec4 at = glm::dmat4(view.view_from_world()) * glm::dvec4(glm::dvec3(light.position), 1.0);
        const double z = -at.z - light.range;
        const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(glm::dvec2(at), -z, 1.0);
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        const glm::dvec2 pixel(0.5 * (ndc.x + 1.0) * width, 0.5 * (ndc.y + 1.0) * height);
        const double radius = light.range / z * std::abs(view.clip_from_view()[1][1]) * 0.5 * height;
        low = glm::min(low, pixel - radius);
        high = glm::max(high, pixel + radius);
      }
      for (const double tile : {16.0, 32.0}) {
        EXPECT_EQ(glm::floor(low / tile), glm::floor(high / tile)) << tile << " px, " << n << " lights, " << width;
      }
    }
  }
}

TEST(AdversarialScenes, NearPlaneHasLightsAroundTheEye) {
  const Place& kiosk = place("near-plane");
  const glm::vec3 eye(kiosk.scene.cameras.front().world_from_camera[3]);
  for (const std::uint32_t n : {64U, 65536U}) {
    int around = 0;
    int behind = 0;
    for (const Light& light : place_lights(kiosk.air, {.count = n})) {
      const glm::vec3 away = glm::vec3(light.position) - eye;
      EXPECT_LE(glm::length(away), 0.8F * std::sqrt(3.0F));
      around += glm::length(away) < light.range ? 1 : 0;
      behind += glm::dot(away, -glm::vec3(kiosk.scene.cameras.front().world_from_camera[2])) < 0.0F ? 1 : 0;
    }
    EXPECT_GT(around, 8) << n;
    EXPECT_GT(behind, static_cast<int>(n / 4)) << n;
  }
}

TEST(AdversarialScenes, HugeAndTinySpansFourOrders) {
  const Place& hall = place("huge-and-tiny");
  for (const std::uint32_t n : {1024U, 65536U, 1U << 20U}) {
    const std::vector<Light> lights = place_lights(hall.air, {.count = n});
    const auto [low, high] = std::ranges::minmax(lights, {}, &Light::range);
    EXPECT_GT(high.range / low.range, 4e3F) << n;
    EXPECT_LE(high.range / low.range, 1.001e4F) << n;
    double volume = 0.0;  // of all spheres, over the air's: what overlaps, walls left out
    for (const Light& light : lights) volume += 4.0 / 3.0 * std::numbers::pi * std::pow(double{light.range}, 3.0);
    EXPECT_GT(volume / hall.air.volume(), 4.0) << n;
    EXPECT_LT(volume / hall.air.volume(), 80.0) << n;
  }
  const std::vector<Light> million = place_lights(hall.air, {.count = 1U << 20U});
  EXPECT_GT(std::ranges::count_if(million, [](const Light& light) { return light.range > 1.0F; }), 3);
  EXPECT_GT(std::ranges::count_if(million, [](const Light& light) { return light.range < 0.02F; }), 100'000);
}

TEST(AdversarialScenes, NeedlesAreLongAndThin) {
  const Place& hall = place("needles");
  const std::vector<Light> points = place_lights(hall.air, {.count = 500, .spots = 0.0F});
  const std::vector<Light> spots = place_lights(hall.air, {.count = 500, .spots = 1.0F});
  for (std::size_t i = 0; i < spots.size(); ++i) {
    EXPECT_EQ(spots[i].type, LightType::spot);
    EXPECT_FLOAT_EQ(spots[i].outer_angle, 0.5F * std::numbers::pi_v<float> / 180.0F);
    EXPECT_LE(spots[i].inner_angle, spots[i].outer_angle);
    EXPECT_FLOAT_EQ(spots[i].range, 8.0F * points[i].range);
  }
}

TEST(AdversarialScenes, NoLightComesThroughTheWall) {
  const Place& yard = place("wall");
  const View view = first_view(yard.scene, 320, 100);
  for (const std::uint32_t n : COUNTS) {
    for (const Light& light : place_lights(yard.air, {.count = n, .frame = 100})) {
      EXPECT_LT(light.position.z + light.range, -4.0F) << "reaches the wall's front";
    }
  }
  // The picture's corners, and wider than any screen, see the wall, not what is beside it.
  for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(320, 0), glm::dvec2(0, 100), glm::dvec2(320, 100)}) {
    const glm::dvec3 eye(glm::dmat4(view.world_from_view())[3]);
    const glm::dvec3 through(glm::dmat4(view.world_from_view()) *
                             glm::dvec4(glm::dvec3(view.view_position(corner, 1.0)), 1.0));
    const glm::dvec3 hit = eye + (-4.0 - eye.z) / (through.z - eye.z) * (through - eye);
    EXPECT_LT(std::abs(hit.x), 59.0);
    EXPECT_GT(hit.y, -7.0);
    EXPECT_LT(hit.y, 39.0);
  }
}

TEST(AdversarialScenes, StackHasManyLayers) {
  const Scene& stack = place("stack").scene;
  EXPECT_GE(stack.instances.size(), 32U);
  const lamp::app::Box box = *stack.placement.box;
  EXPECT_GT(box.max.z - box.min.z, 70.0F);
}

}  // namespace
