// Triangles that share edges and lie in a plane, merged to convex polygons.
// Promise: seen from a point that is not in its plane, the directions inside of all edges of a polygon all meet one
// of its triangles, and within `thickness` of its plane.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lamplight/occlusion.h"

namespace lamp::world {

struct ConvexPolygon {
  std::vector<glm::dvec3> corners;  ///< counter-clockwise around the normal
  glm::dvec3 normal{0.0};           ///< unit
  double offset = 0.0;              ///< dot(normal, a point of the plane)
  double thickness = 0.0;           ///< m; corners of its triangles are so near to the plane
  double tilt = 0.0;                ///< |normal - a triangle's|, at most
};

struct MergedTriangles {
  std::vector<ConvexPolygon> polygons;
  std::size_t left_out = 0;  ///< triangles without area or with a corner that is not finite
};

[[nodiscard]] MergedTriangles merge_triangles(std::span<const OccluderTriangle> triangles);

}  // namespace lamp::world
