// Shapes around lights, as lines over the picture: what a method rasterises, and what shadow maps cut. And the squares
// of a light's shadow map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "lamplight/shared/shadow.h"

namespace lamp::app {

/// Triangles around a light, in world space.
struct LightShape {
  std::uint32_t light = 0;
  bool cut = false;                ///< to what its shadow map lets it light
  bool inside = false;             ///< the eye may be
  std::vector<glm::vec3> corners;  ///< three a triangle
};

/// The meshes that the first method rasterises.
struct ShownProxies {
  std::string refused;      ///< why there are none
  std::uint32_t drawn = 0;  ///< by the method
  std::uint32_t cut = 0;
  std::uint32_t inside = 0;
  std::vector<LightShape> shapes;  ///< of those that were asked for, at most MOST_SHAPES
};
inline constexpr std::size_t MOST_SHAPES = 128;  // more are a tangle

/// What is known of the shadow map of the light that is looked at.
struct ShownShadow {
  std::uint32_t light = 0;
  shared::ShadowMap map;                            ///< none: SHADOW_NONE
  std::uint32_t age = 0;                            ///< frames since it was drawn
  std::uint32_t side = 0;                           ///< of a picture of a square
  std::vector<std::vector<std::uint32_t>> squares;  ///< RGBA, red lowest, row by row
  LightShape shape;
};

}  // namespace lamp::app
