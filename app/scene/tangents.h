// Normals and tangents for triangle lists that lack them.
// Based on: glTF 2.0 specification, section 3.7.2.1 (flat normals); Lengyel, Foundations of Game Engine Development 2:
// Rendering (2019), section 7.5 (tangent vectors of a triangle mesh).
// Promise: unit vectors, no NaN, whatever the triangles are.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// Vertices and the triangles over them, three indices each.
struct Triangles {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Gives each triangle three vertices of its own with the triangle's normal.
void make_flat_normals(Triangles& triangles);

/// Makes every normal a unit vector. Normals of length 0 become the mean of the adjoining triangles' normals, weighted
/// by area; the result is how many there were.
std::size_t repair_normals(Triangles& triangles);

/// Tangents along the u axis of texture coordinates 0 or 1. A vertex between triangles of opposite handedness is split.
void make_tangents(Triangles& triangles, std::uint32_t uv);

/// Makes every tangent a unit vector with w = 1 or -1. Tangents of length 0 become any vector across the normal; the
/// result is how many there were.
std::size_t repair_tangents(Triangles& triangles);

}  // namespace lamp::app
