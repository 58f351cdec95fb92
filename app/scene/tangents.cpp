// Normals and tangents for triangle lists that lack them.
// Based on: glTF 2.0 specification, section 3.7.2.1 (flat normals); Lengyel, Foundations of Game Engine Development 2:
// Rendering (2019), section 7.5 (tangent vectors of a triangle mesh).
// Promise: unit vectors, no NaN, whatever the triangles are.
// SPDX-License-Identifier: Apache-2.0
#include "scene/tangents.h"

#include <array>
#include <cmath>
#include <optional>

namespace lamp::app {
namespace {

/// The unit vector, or nothing where a length of 0 (or beyond floats) leaves no direction.
std::optional<glm::vec3> unit(glm::dvec3 vector) {
  const double length = glm::length(vector);
  if (!(length > 1e-30) || !std::isfinite(length)) return std::nullopt;
  return glm::vec3(vector / length);
}

/// Some unit vector across `normal`: from the axis that is furthest from it.
glm::vec3 across(glm::vec3 normal) {
  const glm::vec3 size = glm::abs(normal);
  const glm::vec3 axis = size.x <= size.y && size.x <= size.z ? glm::vec3(1, 0, 0)
                         : size.y <= size.z                   ? glm::vec3(0, 1, 0)
                                                              : glm::vec3(0, 0, 1);
  return glm::normalize(glm::cross(axis, normal));
}

std::array<const Vertex*, 3> corners(const Triangles& triangles, std::size_t first) {
  const auto at = [&](std::size_t i) { return &triangles.vertices[triangles.indices[first + i]]; };
  return {at(0), at(1), at(2)};
}

/// Twice the triangle's area along its normal (counter-clockwise is the front).
glm::dvec3 area_normal(const std::array<const Vertex*, 3>& corner) {
  const glm::dvec3 origin = corner[0]->position;
  return glm::cross(glm::dvec3(corner[1]->position) - origin, glm::dvec3(corner[2]->position) - origin);
}

/// The direction in which u grows, weighted by area, and whether the texture is mirrored.
struct UAxis {
  glm::dvec3 direction{0.0};
  bool mirrored = false;
};

/// Nothing for a triangle without area, in space or in the texture.
std::optional<UAxis> u_axis(const std::array<const Vertex*, 3>& corner, std::uint32_t uv) {
  const glm::dvec3 origin = corner[0]->position;
  const glm::dvec3 edge1 = glm::dvec3(corner[1]->position) - origin;
  const glm::dvec3 edge2 = glm::dvec3(corner[2]->position) - origin;
  const glm::dvec2 uv1 = glm::dvec2(corner[1]->uv[uv]) - glm::dvec2(corner[0]->uv[uv]);
  const glm::dvec2 uv2 = glm::dvec2(corner[2]->uv[uv]) - glm::dvec2(corner[0]->uv[uv]);
  const double determinant = uv1.x * uv2.y - uv2.x * uv1.y;
  if (determinant == 0.0) return std::nullopt;
  const double sign = determinant < 0.0 ? -1.0 : 1.0;
  const std::optional<glm::vec3> direction = unit(sign * (edge1 * uv2.y - edge2 * uv1.y));
  if (!direction) return std::nullopt;
  return UAxis{glm::dvec3(*direction) * glm::length(area_normal(corner)), determinant < 0.0};
}

/// The part of `direction` across `normal` as a unit vector, or any such vector where there is no such part.
glm::vec3 orthogonal_to(glm::vec3 normal, glm::dvec3 direction) {
  const glm::dvec3 n = normal;
  return unit(direction - n * glm::dot(n, direction)).value_or(across(normal));
}

}  // namespace

void make_flat_normals(Triangles& triangles) {
  std::vector<Vertex> vertices;
  vertices.reserve(triangles.indices.size());
  for (std::size_t first = 0; first + 3 <= triangles.indices.size(); first += 3) {
    const auto corner = corners(triangles, first);
    const glm::vec3 normal = unit(area_normal(corner)).value_or(glm::vec3(0, 1, 0));
    for (const Vertex* vertex : corner) {
      vertices.push_back(*vertex);
      vertices.back().normal = normal;
    }
  }
  triangles.vertices = std::move(vertices);
  for (std::size_t i = 0; i < triangles.indices.size(); ++i) triangles.indices[i] = static_cast<std::uint32_t>(i);
}

std::size_t repair_normals(Triangles& triangles) {
  std::vector<std::uint32_t> without;
  for (std::size_t i = 0; i < triangles.vertices.size(); ++i) {
    const std::optional<glm::vec3> normal = unit(triangles.vertices[i].normal);
    if (normal) triangles.vertices[i].normal = *normal;
    if (!normal) without.push_back(static_cast<std::uint32_t>(i));
  }
  if (without.empty()) return 0;

  std::vector<glm::dvec3> sums(triangles.vertices.size(), glm::dvec3(0.0));
  for (std::size_t first = 0; first + 3 <= triangles.indices.size(); first += 3) {
    const glm::dvec3 normal = area_normal(corners(triangles, first));
    for (std::size_t i = 0; i < 3; ++i) sums[triangles.indices[first + i]] += normal;
  }
  for (const std::uint32_t i : without) triangles.vertices[i].normal = unit(sums[i]).value_or(glm::vec3(0, 1, 0));
  return without.size();
}

void make_tangents(Triangles& triangles, std::uint32_t uv) {
  enum class Side : std::uint8_t { none, plain, mirrored };
  constexpr std::uint32_t NO_TWIN = ~0U;
  struct State {
    glm::dvec3 sum{0.0};
    Side side = Side::none;        ///< of the first triangle at the vertex
    std::uint32_t twin = NO_TWIN;  ///< the copy that the other side's triangles use
  };
  std::vector<State> states(triangles.vertices.size());

  for (std::size_t first = 0; first + 3 <= triangles.indices.size(); first += 3) {
    const std::optional<UAxis> axis = u_axis(corners(triangles, first), uv);
    if (!axis) continue;
    const Side side = axis->mirrored ? Side::mirrored : Side::plain;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& index = triangles.indices[first + i];
      if (states[index].side == Side::none) states[index].side = side;
      if (states[index].side != side) {
        if (states[index].twin == NO_TWIN) {
          states[index].twin = static_cast<std::uint32_t>(triangles.vertices.size());
          const Vertex copy = triangles.vertices[index];
          triangles.vertices.push_back(copy);
          states.push_back({.side = side});
        }
        index = states[index].twin;
      }
      states[index].sum += axis->direction;
    }
  }
  for (std::size_t i = 0; i < triangles.vertices.size(); ++i) {
    Vertex& vertex = triangles.vertices[i];
    const float handedness = states[i].side == Side::mirrored ? -1.0F : 1.0F;
    vertex.tangent = glm::vec4(orthogonal_to(vertex.normal, states[i].sum), handedness);
  }
}

std::size_t repair_tangents(Triangles& triangles) {
  std::size_t repaired = 0;
  for (Vertex& vertex : triangles.vertices) {
    const std::optional<glm::vec3> tangent = unit(glm::vec3(vertex.tangent));
    if (!tangent) ++repaired;
    vertex.tangent = glm::vec4(tangent.value_or(across(vertex.normal)), vertex.tangent.w < 0.0F ? -1.0F : 1.0F);
  }
  return repaired;
}

}  // namespace lamp::app
