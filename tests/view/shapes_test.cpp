// Shapes around lights: proxies hold all that a light reaches, what shadow maps bound lies within the range.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "view/shadow_overlay.h"
#include "view/stage.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

ViewState state_with(const char* method) {
  ViewState state = small_viewer().state;
  state.request.method = method;
  state.request.scene = "posts";
  state.request.spots = 0.0F;
  state.request.lights = 40;
  state.proxies = LightMarks::all;
  return state;
}

/// m: how near to a point the planes of a closed mesh's triangles come.
float nearest_plane(const std::vector<glm::vec3>& corners, const glm::vec3& point) {
  float nearest = 1e30F;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const glm::vec3 normal = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
    if (glm::length(normal) > 1e-12F)
      nearest = std::min(nearest, std::abs(glm::dot(glm::normalize(normal), corners[i] - point)));
  }
  return nearest;
}

TEST(Shapes, ProxiesHoldTheirLights) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  for (const char* method : {"drobot-raster-tile", "drobot-raster-cluster"}) {
    const Shown shown = stage.draw(state_with(method), {96, 54});
    ASSERT_TRUE(shown.proxies);
    ASSERT_GE(shown.proxies->shapes.size(), 40U);
    for (const LightShape& shape : shown.proxies->shapes) {
      const shared::Light& light = shown.lights->all()[shape.light];
      ASSERT_EQ(shape.corners.size(), 180U);
      EXPECT_GE(nearest_plane(shape.corners, light.position), light.range) << method << " light " << shape.light;
    }
  }
}

TEST(Shapes, OfShadowsLieWithinTheRange) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = state_with("drobot-raster-tile");
  state.request.shadows.filter = "hard";
  state.light = 1;
  for (const ShadowShape kind : {ShadowShape::bound, ShadowShape::mesh}) {
    state.shadow_shape = kind;
    const Shown shown = stage.draw(state, {96, 54});
    ASSERT_TRUE(shown.shadow);
    ASSERT_FALSE(shown.shadow->squares.empty());
    EXPECT_EQ(shown.shadow->squares.front().size(), std::size_t{shown.shadow->side} * shown.shadow->side);
    const shared::Light& light = shown.lights->all()[1];
    ASSERT_FALSE(shown.shadow->shape.corners.empty());
    float nearest = 1e30F;
    for (const glm::vec3& corner : shown.shadow->shape.corners) {
      const float distance = glm::length(corner - glm::vec3(Vec3(light.position)));
      EXPECT_LE(distance, 1.3F * light.range);
      nearest = std::min(nearest, distance);
    }
    EXPECT_LT(nearest, 0.99F * light.range);  // something is in the way
  }
}

TEST(Shapes, SquaresBecomePictures) {
  const shared::ShadowMap map{.kind = shared::SHADOW_SPOT, .near_m = 0.1F, .range_m = 10.0F, .side = 4};
  std::vector<float> texels(16, 0.0F);
  texels[4 + 3] = 1.0F;  // near, at (3, 1)
  const std::vector<std::uint32_t> picture = picture_of_square(Palette::grey, map, texels, 2);
  ASSERT_EQ(picture.size(), 4U);
  EXPECT_EQ(picture[0] & 0xFFFFFFU, 0U);
  EXPECT_GT(picture[1] & 0xFFU, 200U);
}

}  // namespace
}  // namespace lamp::app
