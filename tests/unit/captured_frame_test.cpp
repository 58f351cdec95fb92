// What a captured frame is made into: texels of the G-buffer and back, normals from depth, air for generated lights.
// SPDX-License-Identifier: Apache-2.0
#include "scene/captured_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/gbuffer_texels.h"
#include "scene/open_air.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

View view_of_size(std::uint32_t width, std::uint32_t height, bool flat = false) {
  const Window window{.left = -1.0, .right = 1.2, .bottom = -0.8, .top = 0.7};
  const glm::dmat4 clip = flat ? orthographic(window, 0.1, 50.0) : perspective(window, 0.1, INFINITE_FAR);
  const glm::dmat4 pose{{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {5, 2, -3, 1}};  // looks along -X
  return View::create(width, height, clip, glm::inverse(pose)).value();
}

GBufferTexels texels_of(std::size_t count) {
  return {.depth = std::vector<float>(count, 0.5F),
          .base_color = std::vector<glm::u8vec4>(count, glm::u8vec4(0, 0, 0, 255)),
          .surface = std::vector<glm::uvec2>(count, glm::uvec2(0)),
          .emission = std::vector<glm::u16vec4>(count, glm::u16vec4(0, 0, 0, 0x3C00))};
}

TEST(GBufferTexels, EveryColourAndFactorComesBack) {
  GBufferTexels texels = texels_of(256);
  for (std::uint32_t i = 0; i < 256; ++i) {
    texels.base_color[i] = {i, 255 - i, i ^ 0x55U, 255};
    texels.surface[i].y = i | (255 - i) << 8U | (i ^ 0xAAU) << 16U;
  }
  const GBufferTexels again = encode(decode(view_of_size(16, 16), texels));
  EXPECT_EQ(again.base_color, texels.base_color);
  EXPECT_EQ(again.surface, texels.surface);
  EXPECT_EQ(again.emission, texels.emission);
  EXPECT_EQ(again.depth, texels.depth);
}

TEST(GBufferTexels, EveryFiniteEmissionComesBack) {
  GBufferTexels texels = texels_of(0x7C00);
  for (std::uint32_t i = 0; i < 0x7C00; ++i) texels.emission[i] = {i, 0x7BFF - i, i, 0x3C00};
  EXPECT_EQ(encode(decode(view_of_size(0x7C00, 1), texels)).emission, texels.emission);
}

/// Codes of octahedral normals, with the edges and the folds; some share a normal, so normals are compared.
TEST(GBufferTexels, EveryNormalComesBack) {
  std::vector<std::int32_t> values{-32768, -32767, -32766, -16384, -1, 0, 1, 2, 16383, 16384, 32766, 32767};
  for (std::int32_t value = -32767; value < 32768; value += 311) values.push_back(value);
  GBufferTexels texels = texels_of(values.size() * values.size());
  std::size_t i = 0;
  for (const std::int32_t x : values)
    for (const std::int32_t y : values)
      texels.surface[i++].x = static_cast<std::uint16_t>(x) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(y))
                                                                  << 16U;
  const View view = view_of_size(static_cast<std::uint32_t>(i), 1);
  const CapturedFrame frame = decode(view, texels);
  const GBufferTexels once = encode(frame);
  const CapturedFrame again = decode(view, once);
  for (std::size_t n = 0; n < i; ++n) {
    const std::int32_t x = static_cast<std::int16_t>(texels.surface[n].x & 0xFFFFU);
    const std::int32_t y = static_cast<std::int16_t>(texels.surface[n].x >> 16U);
    ASSERT_NEAR(glm::length(frame.normal[n]), 1.0F, 1e-6F) << x << " " << y;
    if (std::abs(x) < 32767 && std::abs(y) < 32767) {
      ASSERT_EQ(once.surface[n].x, texels.surface[n].x) << x << " " << y;
    }
    ASSERT_LT(glm::distance(again.normal[n], frame.normal[n]), 1e-7F) << x << " " << y;
  }
}

TEST(GBufferTexels, SkyIsEmpty) {
  GBufferTexels texels = texels_of(2);
  texels.depth[1] = 0.0F;
  texels.base_color[1] = {1, 2, 3, 4};
  const GBufferTexels again = encode(decode(view_of_size(2, 1), texels));
  EXPECT_EQ(again.base_color[1], glm::u8vec4(0));
  EXPECT_EQ(again.surface[1], glm::uvec2(0));
}

/// The depth of a plane `normal . (p - point) = 0` in world space; sky where the ray misses it.
std::vector<float> plane_depth(const View& view, const glm::dvec3& point, const glm::dvec3& normal) {
  std::vector<float> depth;
  for (std::uint32_t y = 0; y < view.height(); ++y) {
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      const auto at = [&](double z_view) {
        return glm::dvec3(glm::dmat4(view.world_from_view()) *
                          glm::dvec4(glm::dvec3(view.view_position({x + 0.5, y + 0.5}, z_view)), 1.0));
      };
      const double below = glm::dot(normal, at(1.0) - point);
      const double above = glm::dot(normal, at(2.0) - point);
      const double z_view = 1.0 + below / (below - above);
      const glm::dmat4& p = view.clip_from_view();
      const double d = (p[3][2] - p[2][2] * z_view) / (p[3][3] - p[2][3] * z_view);
      depth.push_back(z_view > 0.1 && d > 0.0 && d < 1.0 ? static_cast<float>(d) : 0.0F);
    }
  }
  return depth;
}

TEST(DepthNormals, OfPlanesAreThePlanes) {
  for (const bool flat : {false, true}) {
    const View view = view_of_size(32, 24, flat);
    for (const glm::dvec3 normal : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0.3), glm::dvec3(1, -0.5, 2)}) {
      const glm::dvec3 unit = glm::normalize(normal);
      const std::vector<float> depth = plane_depth(view, {-1, 2, -3}, unit);
      const std::vector<glm::vec3> normals = normals_from_depth(view, depth);
      std::size_t covered = 0;
      for (std::size_t i = 0; i < depth.size(); ++i) {
        if (depth[i] == 0.0F) {
          EXPECT_EQ(normals[i], glm::vec3(0.0F));
          continue;
        }
        ++covered;
        ASSERT_LT(glm::distance(glm::dvec3(normals[i]), unit), 2e-3) << i;
      }
      EXPECT_GT(covered, 100U);
    }
  }
}

/// A near wall over the left half, a far one over the right: neither bends at the edge.
TEST(DepthNormals, EdgesDoNotBendSurfaces) {
  const View view = view_of_size(16, 8);
  const std::vector<float> near = plane_depth(view, {3, 2, -3}, {1, 0, 0});
  std::vector<float> depth = plane_depth(view, {-20, 2, -3}, {1, 0, 0});
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (i % 16 < 7) depth[i] = near[i];
  for (const glm::vec3& normal : normals_from_depth(view, depth))
    EXPECT_LT(glm::distance(normal, glm::vec3(1, 0, 0)), 1e-3F);
}

TEST(DepthNormals, ASinglePixelFacesTheEye) {
  const View view = view_of_size(3, 3);
  std::vector<float> depth(9, 0.0F);
  depth[4] = 0.05F;
  const glm::vec3 normal = normals_from_depth(view, depth)[4];
  const glm::dvec3 place = view.world_position(1, 1, 0.05F);
  EXPECT_LT(glm::distance(glm::dvec3(normal), glm::normalize(glm::dvec3(5, 2, -3) - place)), 1e-5);
}

TEST(CapturedAir, LiesBetweenTheEyeAndTheSurfaces) {
  const View view = view_of_size(64, 48);
  CapturedFrame frame{.view = view, .depth = plane_depth(view, {-5, 2, -3}, {1, 0, 0})};
  const OpenAir air = find_open_air(frame);
  EXPECT_GT(air.cells.size(), 100U);
  for (const AirCell& cell : air.cells) {
    EXPECT_GT(cell.min.x, -5.0F - 0.1F * air.cell_m) << "behind the wall";
    EXPECT_LT(cell.min.x, 5.0F) << "behind the eye";
  }
  const Scene scene{.captured = std::move(frame)};
  const std::vector<Light> lights = place_lights(scene, {.count = 500});
  ASSERT_EQ(lights.size(), 500U);
  EXPECT_FALSE(check_lights(lights));
  for (const Light& light : lights) EXPECT_GT(light.position.x, -5.0F);
}

TEST(CapturedAir, IsNeverEmpty) {
  for (const bool flat : {false, true}) {
    const View view = view_of_size(8, 8, flat);
    CapturedFrame frame{.view = view, .depth = std::vector<float>(64, 0.0F)};
    EXPECT_FALSE(find_open_air(frame).cells.empty()) << "only sky";
    frame.depth[20] = 0.25F;
    EXPECT_FALSE(find_open_air(frame).cells.empty()) << "one pixel";
    frame.depth.assign(64, 1.0F);
    EXPECT_FALSE(find_open_air(frame).cells.empty()) << "all of it on the near plane";
  }
}

}  // namespace
}  // namespace lamp::app
