// The glTF loader: point, spot and directional lights of KHR_lights_punctual, as their nodes place them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;
using lamp::LightType;
using lamp::app::Scene;

constexpr float INFINITE = std::numeric_limits<float>::infinity();

void expect_near(glm::vec3 actual, glm::vec3 expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5F) << "component " << i;
}

TEST(GltfLights, ReadsAPointLight) {
  GltfBuilder builder = triangle();
  const json light = builder.light({{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 40}, {"range", 6.5}});
  builder.root({{"translation", {1, 2, 3}}, {"scale", {10, 10, 10}}, {"extensions", light}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].type, LightType::point);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1, 0.5F, 0.25F));
  EXPECT_EQ(scene.lights[0].intensity, 40.0F);
  EXPECT_EQ(scene.lights[0].range, 6.5F) << "not scaled with the node";
}

TEST(GltfLights, FillsInDefaults) {
  GltfBuilder builder = triangle();
  builder.root({{"extensions", builder.light({{"type", "spot"}, {"spot", json::object()}})}});
  const lamp::Light light = load(builder).lights.at(0);
  EXPECT_EQ(light.range, INFINITE);
  EXPECT_EQ(light.color, glm::vec3(1));
  EXPECT_EQ(light.intensity, 1.0F);
  EXPECT_EQ(light.inner_angle, 0.0F);
  EXPECT_NEAR(light.outer_angle, std::numbers::pi_v<float> / 4.0F, 1e-6F);
  expect_near(light.direction, {0, 0, -1});
}

TEST(GltfLights, AimsSpotsWithTheirNodes) {
  GltfBuilder builder = triangle();
  const double half = std::sqrt(0.5);
  // pi/2 as exporters that compute in float write it.
  const json light =
      builder.light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 1.5707963705062866}}}});
  builder.root({{"rotation", {-half, 0, 0, half}}, {"children", {2}}});
  builder.add("nodes", {{"translation", {0, 5, 0}}, {"scale", {2, 2, 3}}, {"extensions", light}});
  const lamp::Light spot = load(builder).lights.at(0);
  EXPECT_EQ(spot.type, LightType::spot);
  expect_near(spot.direction, {0, -1, 0});
  expect_near(spot.position, {0, 0, -5});
  EXPECT_EQ(spot.inner_angle, 0.5F);
  EXPECT_FALSE(lamp::check_lights(std::vector<lamp::Light>{spot}).has_value());
}

TEST(GltfLights, KeepsDirectionalLightsApart) {
  GltfBuilder builder = triangle();
  const double half = std::sqrt(0.5);
  const json light = builder.light({{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 3}});
  builder.root({{"rotation", {0, half, 0, half}}, {"extensions", light}});
  const Scene scene = load(builder);
  EXPECT_TRUE(scene.lights.empty());
  ASSERT_EQ(scene.directional_lights.size(), 1U);
  expect_near(scene.directional_lights[0].direction, {-1, 0, 0});
  expect_near(scene.directional_lights[0].illuminance, {3, 1.5F, 0});
}

TEST(GltfLights, PlacesOneDefinitionManyTimesInTheOrderOfTheNodes) {
  GltfBuilder builder = triangle();
  const json light = builder.light({{"type", "point"}});
  for (int i = 0; i < 5; ++i) builder.root({{"translation", {i, 0, 0}}, {"extensions", light}});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.lights.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(scene.lights[i].position.x, static_cast<float>(i));
}

TEST(GltfLights, AreHiddenByAScaleOfZero) {
  GltfBuilder builder = triangle();
  for (const char* type : {"point", "spot", "directional"}) {
    builder.root({{"scale", {0, 0, 0}}, {"children", {builder.document["nodes"].size() + 1}}});
    builder.add("nodes", {{"extensions", builder.light({{"type", type}, {"spot", json::object()}})}});
  }
  const Scene scene = load(builder);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_TRUE(scene.directional_lights.empty());
  EXPECT_EQ(scene.notes, std::vector<std::string>{"3 lights left out: a scale of 0 hides them"});
}

TEST(GltfLights, ShineFromFlatNodesWhereTheyHaveADirection) {
  GltfBuilder builder = triangle();
  for (const char* type : {"point", "spot"})
    for (const int flat : {0, 2}) {
      json scale = {1, 1, 1};
      scale[static_cast<std::size_t>(flat)] = 0;
      builder.root({{"scale", scale}, {"extensions", builder.light({{"type", type}, {"spot", json::object()}})}});
    }
  const Scene scene = load(builder);
  EXPECT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.notes, std::vector<std::string>{"1 lights left out: a scale of 0 hides them"});
}

}  // namespace
