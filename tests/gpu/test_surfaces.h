// Small scenes whose picture is known in closed form, and that closed form in double precision.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "lamplight/view.h"
#include "scene/scene.h"

namespace lamp::app {

/// A wall in the plane z = 0, `half` metres to each side, that faces a camera 4 m before it at (0, 0, 4).
[[nodiscard]] Scene wall_scene(const Material& material, float half = 50.0F);

/// One more quad, in the plane z = `z`, facing +Z: corners (x0, y0) and (x1, y1), uv 0 .. 1, v down.
struct Quad {
  float x0, y0, x1, y1, z;
};
void add_wall(Scene& scene, const Quad& quad, std::uint32_t material);

/// What a surface reflects per unit of irradiance perpendicular to the light, times n.l: glTF 2.0, appendix B, with
/// height-correlated Smith visibility.
struct Reflection {
  glm::dvec3 normal{0.0, 0.0, 1.0};
  glm::dvec3 to_eye{0.0, 0.0, 1.0};
  glm::dvec3 to_light{0.0, 0.0, 1.0};
  glm::dvec3 base_color{1.0};
  double metallic = 0.0;
  double roughness = 1.0;
};
[[nodiscard]] glm::dvec3 reflected(const Reflection& r);

/// The point of the plane with this normal through the origin that a pixel's centre shows.
[[nodiscard]] glm::dvec3 seen_point(const View& view, glm::uvec2 pixel, const glm::dvec3& plane_normal);

/// Radiance that a point light makes on a surface at `position`, as KHR_lights_punctual attenuates it.
[[nodiscard]] glm::dvec3 lit_by_point(const Light& light, const glm::dvec3& position, Reflection surface,
                                      const View& view);

}  // namespace lamp::app
