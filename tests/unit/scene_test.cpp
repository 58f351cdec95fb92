// Bounds of scenes: of what instances place, in the world.
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace {

using lamp::app::Scene;

Scene three_points() {
  Scene scene;
  scene.vertices.resize(4);
  scene.vertices[1].position = {1, 2, 3};
  scene.vertices[2].position = {4, 0, -1};
  scene.vertices[3].position = {100, 100, 100};
  scene.indices = {0, 0, 1};
  scene.meshes.push_back({.first_index = 0, .index_count = 3, .vertex_offset = 1, .material = 0});
  return scene;
}

TEST(SceneBounds, CoverPlacedVerticesOnly) {
  Scene scene = three_points();
  scene.instances.push_back({0, glm::translate(glm::mat4(1.0F), glm::vec3(10, 0, 0))});
  EXPECT_EQ(lamp::app::bounds(scene).min, glm::vec3(11, 0, -1));
  EXPECT_EQ(lamp::app::bounds(scene).max, glm::vec3(14, 2, 3));
  scene.instances.push_back({0, glm::scale(glm::mat4(1.0F), glm::vec3(-1, 1, 2))});
  EXPECT_EQ(lamp::app::bounds(scene).min, glm::vec3(-4, 0, -2));
  EXPECT_EQ(lamp::app::bounds(scene).max, glm::vec3(14, 2, 6));
}

TEST(SceneBounds, OfNothingAreAUnitBox) {
  for (const Scene& scene : {Scene{}, three_points()}) {
    EXPECT_EQ(lamp::app::bounds(scene).min, glm::vec3(-0.5F));
    EXPECT_EQ(lamp::app::bounds(scene).max, glm::vec3(0.5F));
  }
}

TEST(SceneLights, AreAtMostAsBrightAsPicturesCanAddUp) {
  std::vector<lamp::Light> lights(2);
  lights[1].color = {0.5F, 1.0F, 0.5F};
  lights[1].intensity = lamp::app::LARGEST_INTENSITY;
  EXPECT_FALSE(lamp::app::check_shown_lights(lights));
  lights[1].color = {0.5F, 4.0F, 0.5F};
  EXPECT_EQ(lamp::app::check_shown_lights(lights)->text(),
            "light 1: color times intensity must be at most 1e+30 candela, got 4e+30");
  lights[0].range = -1.0F;
  EXPECT_EQ(lamp::app::check_shown_lights(lights)->text(), "light 0: range must be >= 0 m, got -1");
}

}  // namespace
