// Lights: each stated range of light.h, and the numbers that packing derives.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/light.h"

#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "lamplight/view.h"
#include "lamplight/world_tree.h"

namespace {

using lamp::Light;
using lamp::LightType;

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;

constexpr float DEGREE = std::numbers::pi_v<float> / 180.0F;

Light spot() { return {.type = LightType::spot, .range = 5.0F, .direction = {0.0F, -2.0F, 0.0F}, .inner_angle = 0.2F}; }

struct Fault {
  std::string field;
  std::function<void(Light&)> make;
};

const std::vector<Fault>& faults_of_any_light() {
  static const std::vector<Fault> FAULTS{
      {"type", [](Light& l) { l.type = static_cast<LightType>(7); }},
      {"position", [](Light& l) { l.position.y = NOT_A_NUMBER; }},
      {"position", [](Light& l) { l.position.z = INFINITE; }},
      {"range", [](Light& l) { l.range = NOT_A_NUMBER; }},
      {"range", [](Light& l) { l.range = -1.0F; }},
      {"color", [](Light& l) { l.color.x = NOT_A_NUMBER; }},
      {"color", [](Light& l) { l.color.y = -0.1F; }},
      {"color", [](Light& l) { l.color.z = INFINITE; }},
      {"intensity", [](Light& l) { l.intensity = NOT_A_NUMBER; }},
      {"intensity", [](Light& l) { l.intensity = -0.5F; }},
      {"intensity", [](Light& l) { l.intensity = INFINITE; }},
      {"color", [](Light& l) { l.color.x = l.intensity = 1e30F; }},
  };
  return FAULTS;
}

const std::vector<Fault>& faults_of_spots() {
  static const std::vector<Fault> FAULTS{
      {"direction", [](Light& l) { l.direction = glm::vec3(0.0F); }},
      {"direction", [](Light& l) { l.direction.x = NOT_A_NUMBER; }},
      {"direction", [](Light& l) { l.direction.x = INFINITE; }},
      {"outer angle", [](Light& l) { l.outer_angle = 1.5708F; }},
      {"outer angle", [](Light& l) { l.outer_angle = NOT_A_NUMBER; }},
      {"outer angle", [](Light& l) { l.outer_angle = l.inner_angle = -0.1F; }},
      {"inner angle", [](Light& l) { l.inner_angle = 0.8F; }},
      {"inner angle", [](Light& l) { l.inner_angle = -0.1F; }},
      {"inner angle", [](Light& l) { l.inner_angle = NOT_A_NUMBER; }},
  };
  return FAULTS;
}

void expect_named(const Light& good, const Fault& fault) {
  std::vector<Light> lights(5, good);
  fault.make(lights[3]);
  const auto error = lamp::check_lights(lights);
  ASSERT_TRUE(error.has_value()) << fault.field;
  EXPECT_EQ(error->text().rfind("light 3: " + fault.field, 0), 0U) << error->text();
  EXPECT_NE(error->text().find("got"), std::string::npos) << error->text();
}

/// What builds lists ahead gets packed lights and refuses the same.
void expect_named_when_packed(const Light& good, const Fault& fault) {
  std::vector<Light> lights(5, good);
  fault.make(lights[3]);
  const auto tree = lamp::WorldTree::build({.lights = lamp::pack(lights)});
  ASSERT_FALSE(tree.ok()) << fault.field;
  EXPECT_EQ(tree.error().source, "light 3") << fault.field;
}

TEST(CheckLights, NamesTheLightAndTheField) {
  for (const Fault& fault : faults_of_any_light()) {
    expect_named(Light{}, fault);
    expect_named(spot(), fault);
    expect_named_when_packed(Light{}, fault);
    expect_named_when_packed(spot(), fault);
  }
  for (const Fault& fault : faults_of_spots()) {
    expect_named(spot(), fault);
    expect_named_when_packed(spot(), fault);
  }
}

TEST(CheckLights, PointLightsLeaveDirectionAndAnglesUnread) {
  for (const Fault& fault : faults_of_spots()) {
    Light light;
    fault.make(light);
    EXPECT_FALSE(lamp::check_lights(std::span(&light, 1)).has_value()) << fault.field;
  }
}

TEST(CheckLights, AcceptsTheEdgesOfEveryRange) {
  Light dark = spot();
  dark.range = 0.0F;
  dark.intensity = 0.0F;
  dark.color = glm::vec3(0.0F);
  dark.inner_angle = dark.outer_angle = 0.0F;
  Light wide = spot();
  wide.range = INFINITE;
  wide.direction = glm::vec3(1e-30F, 0.0F, 0.0F);
  wide.inner_angle = wide.outer_angle = RIGHT_ANGLE;
  const std::vector<Light> lights{Light{}, spot(), dark, wide};
  EXPECT_FALSE(lamp::check_lights(lights).has_value());
  EXPECT_TRUE(lamp::WorldTree::build({.lights = lamp::pack(lights)}).ok());
  EXPECT_FALSE(lamp::check_lights({}).has_value());
}

// With -ffast-math a host's compiler may leave out infinities: public headers have none.
TEST(CheckLights, ALightWithoutARangeNeedsNoInfinity) {
  EXPECT_TRUE(std::isfinite(Light{}.range));
  EXPECT_GE(Light{}.range, lamp::shared::INFINITE_RADIUS);
  EXPECT_TRUE(std::isfinite(lamp::INFINITE_FAR));
}

TEST(CheckLights, NamesTheFirstOfSeveral) {
  std::vector<Light> lights(4);
  lights[2].range = -1.0F;
  lights[3].intensity = -1.0F;
  EXPECT_EQ(lamp::check_lights(lights)->text(), "light 2: range must be >= 0 m, got -1");
}

TEST(PackLight, Spot) {
  Light light = spot();
  light.position = {1.0F, 2.0F, 3.0F};
  light.color = {1.0F, 0.5F, 0.25F};
  light.intensity = 8.0F;
  const lamp::shared::Light packed = lamp::pack(light);
  EXPECT_EQ(packed.position, light.position);
  EXPECT_EQ(packed.range, 5.0F);
  EXPECT_EQ(packed.intensity, glm::vec3(8.0F, 4.0F, 2.0F));
  EXPECT_EQ(packed.type, lamp::shared::LIGHT_SPOT);
  EXPECT_EQ(packed.direction, glm::vec3(0.0F, -1.0F, 0.0F));
  EXPECT_EQ(packed.inner_angle, light.inner_angle);
  EXPECT_EQ(packed.outer_angle, light.outer_angle);
  EXPECT_FLOAT_EQ(packed.cos_outer, 0.70710678F);
  EXPECT_FLOAT_EQ(packed.spot_scale, 1.0F / (std::cos(0.2F) - 0.70710678F));
  EXPECT_FLOAT_EQ(packed.sin_outer, 0.70710678F);
}

TEST(PackLight, RightAngleHasACosineOfExactlyZero) {
  Light light = spot();
  light.outer_angle = RIGHT_ANGLE;
  EXPECT_EQ(lamp::pack(light).cos_outer, 0.0F);
  light.outer_angle = std::nextafter(RIGHT_ANGLE, 0.0F);
  EXPECT_GT(lamp::pack(light).cos_outer, 0.0F);
}

TEST(PackLight, EqualAnglesKeepTheScaleFinite) {
  Light light = spot();
  light.inner_angle = light.outer_angle;
  EXPECT_FLOAT_EQ(lamp::pack(light).spot_scale, 1000.0F);
}

TEST(PackLight, NormalisesTinyAndHugeDirections) {
  Light light = spot();
  for (const float length : {1e-40F, 1e-20F, 1e20F, 3e38F}) {
    light.direction = length * glm::vec3(0.6F, 0.0F, -0.8F);
    const glm::vec3 direction = lamp::pack(light).direction;
    EXPECT_NEAR(direction.x, 0.6F, 1e-4F) << length;
    EXPECT_NEAR(direction.z, -0.8F, 1e-4F) << length;
  }
}

TEST(PackLight, PointLightsHoldNoSpotNumbers) {
  Light light;
  light.direction = glm::vec3(0.0F);
  light.outer_angle = NOT_A_NUMBER;
  const lamp::shared::Light packed = lamp::pack(light);
  EXPECT_EQ(packed.type, lamp::shared::LIGHT_POINT);
  EXPECT_EQ(glm::length(glm::vec3(packed.direction)), 1.0F);
  EXPECT_EQ(packed.outer_angle, 0.0F);
  EXPECT_EQ(packed.spot_scale, 0.0F);
}

TEST(PackLight, ManyKeepTheirOrder) {
  std::vector<Light> lights(3);
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].range = static_cast<float>(i);
  const auto packed = lamp::pack(lights);
  ASSERT_EQ(packed.size(), 3U);
  for (std::size_t i = 0; i < packed.size(); ++i) EXPECT_EQ(packed[i].range, static_cast<float>(i));
}

TEST(BoundingSphere, HoldsAllThatASpotReaches) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  for (int i = 0; i < 20'000; ++i) {
    const float angle = 0.5F * DEGREE + unit(random) * (RIGHT_ANGLE - 0.5F * DEGREE);
    const Light light{.type = LightType::spot,
                      .position = 100.0F * glm::vec3(unit(random), unit(random), unit(random)),
                      .range = 0.1F + 50.0F * unit(random),
                      .direction = glm::vec3(unit(random) - 0.5F, unit(random) - 0.5F, 0.01F + unit(random)),
                      .outer_angle = angle};
    const lamp::shared::Light packed = lamp::pack(light);
    const lamp::shared::LightSphere sphere = lamp::bounding_sphere(packed);
    // Tip, and the rim and the middle of the cap: what is farthest out.
    const glm::vec3 axis = packed.direction;
    const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0.0F, 1.0F, 0.003F)));
    const glm::vec3 rim = light.range * (packed.cos_outer * axis + packed.sin_outer * side);
    for (const glm::vec3& reach : {glm::vec3(0.0F), rim, light.range * axis})
      EXPECT_LE(glm::distance(glm::vec3(sphere.center), glm::vec3(light.position) + reach),
                sphere.radius * 1.0001F + 1e-4F)
          << angle;
    const float least =
        angle < 45.0F * DEGREE ? light.range / (2.0F * packed.cos_outer) : light.range * packed.sin_outer;
    EXPECT_LE(sphere.radius, least * 1.0001F);
  }
}

TEST(BoundingSphere, TellsNothingFromEverything) {
  Light light;
  EXPECT_EQ(lamp::bounding_sphere(lamp::pack(light)).radius, 1e18F) << "infinite range";
  for (const float range : {1e18F, 2e18F, 1e30F, std::numeric_limits<float>::max(), INFINITE})
    for (const LightType type : {LightType::point, LightType::spot}) {
      const Light far{.type = type, .position = {0.0F, -3e18F, 2.0F}, .range = range, .outer_angle = 0.5F};
      EXPECT_EQ(lamp::bounding_sphere(lamp::pack(far)).radius, 1e18F) << range;
      EXPECT_EQ(lamp::bounding_sphere(lamp::pack(far)).center, glm::vec3(0.0F)) << "around the origin";
    }
  light.position = {3.0F, 4.0F, 5.0F};
  EXPECT_EQ(lamp::bounding_sphere(lamp::pack(light)).center, glm::vec3(0.0F));
  light.range = 0.0F;
  EXPECT_LT(lamp::bounding_sphere(lamp::pack(light)).radius, 0.0F);
  Light narrow = spot();
  narrow.inner_angle = narrow.outer_angle = 0.0F;
  EXPECT_LT(lamp::bounding_sphere(lamp::pack(narrow)).radius, 0.0F);
  EXPECT_EQ(lamp::bounding_spheres(lamp::pack(std::vector<Light>(3))).size(), 3U);
}

}  // namespace
