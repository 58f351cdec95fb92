// The glTF loader on real scenes, where the folder with them is there: what is in them is known.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scene/gltf.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::app::load_gltf;
using lamp::app::Scene;

struct Known {
  const char* file;
  std::size_t triangles;
  std::size_t points;
  std::size_t spots;
  std::size_t directional;
  bool infinite_ranges;
  const char* camera;
};

class GltfScenes : public testing::TestWithParam<Known> {};

TEST_P(GltfScenes, HoldsWhatIsKnown) {
  const Known& known = GetParam();
  const auto file = std::filesystem::path(LAMPLIGHT_SHARED_SCENES) / known.file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no scene at " << file;
  const Scene scene = load_gltf(file);

  std::size_t triangles = 0;
  for (const auto& instance : scene.instances) triangles += scene.meshes.at(instance.mesh).index_count / 3;
  EXPECT_EQ(triangles, known.triangles);
  const auto spots = static_cast<std::size_t>(std::ranges::count(scene.lights, LightType::spot, &Light::type));
  EXPECT_EQ(scene.lights.size() - spots, known.points);
  EXPECT_EQ(spots, known.spots);
  EXPECT_EQ(scene.directional_lights.size(), known.directional);
  for (const Light& light : scene.lights) EXPECT_EQ(std::isinf(light.range), known.infinite_ranges);
  EXPECT_FALSE(lamp::check_lights(scene.lights).has_value());
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_EQ(scene.cameras[0].name, known.camera);
  EXPECT_TRUE(scene.flight.has_value());
  EXPECT_TRUE(scene.notes.empty()) << scene.notes[0];
  for (const auto& image : scene.images) EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height);
  for (const auto& vertex : scene.vertices) ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-4F);
}

INSTANTIATE_TEST_SUITE_P(Real, GltfScenes,
                         testing::Values(Known{"sponza/Sponza.gltf", 262267, 0, 0, 0, false, "default"},
                                         Known{"sponza/Sponza_lights.gltf", 262267, 4, 0, 1, false, "default"},
                                         Known{"quake/e1m1.glb", 15756, 198, 0, 0, false, "e1m1_player_start"},
                                         Known{"quake/e3m4.glb", 17692, 338, 101, 0, false, "e3m4_player_start"},
                                         Known{"tps-lights/lights.glb", 5440, 7, 13, 0, true, "default"}),
                         [](const auto& test) {
                           std::string name = std::filesystem::path(test.param.file).stem().string();
                           std::erase(name, '_');
                           return name;
                         });

}  // namespace
