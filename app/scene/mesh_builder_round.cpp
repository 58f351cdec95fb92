// Round parts of procedural scenes: lathes, spheres, tubes, arches.
// Based on: nothing; tubes carry their frame along the path by parallel transport.
// Promise: see mesh_builder.h; normals are smooth but for corners sharper than 40 degrees.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/mesh_builder.h"

namespace lamp::app::procedural {
namespace {

constexpr float CREASE_COSINE = 0.766F;  // cos 40 degrees

/// A circle of vertices: one profile point with one of its normals.
struct Ring {
  glm::vec2 point;   ///< radius, y
  glm::vec2 normal;  ///< in (radius, y)
  float v = 0.0F;    ///< m along the profile
};

/// Two rings for each profile segment, sharing the smooth normals of their ends.
std::vector<std::array<Ring, 2>> rings_of(std::span<const glm::vec2> profile) {
  std::vector<glm::vec2> normals;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 along = glm::normalize(profile[i + 1] - profile[i]);
    normals.emplace_back(along.y, -along.x);
  }
  std::vector<std::array<Ring, 2>> rings;
  float v = 0.0F;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto smooth = [&](std::size_t other) {
      const bool crease = glm::dot(normals[i], normals[other]) < CREASE_COSINE;
      return crease ? normals[i] : glm::normalize(normals[i] + normals[other]);
    };
    const float length = glm::length(profile[i + 1] - profile[i]);
    rings.push_back({Ring{profile[i], smooth(i > 0 ? i - 1 : i), v},
                     Ring{profile[i + 1], smooth(i + 1 < normals.size() ? i + 1 : i), v - length}});
    v -= length;
  }
  return rings;
}

void add_triangle(Geometry& geometry, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  geometry.indices.insert(geometry.indices.end(), {a, b, c});
}

}  // namespace

void add_lathe(Geometry& geometry, const Lathe& lathe) {
  float widest = 0.0F;
  for (const glm::vec2& point : lathe.profile) widest = std::max(widest, point.x);
  const float around = lathe.around_m > 0.0F ? lathe.around_m : 2.0F * PI * widest;
  for (const std::array<Ring, 2>& pair : rings_of(lathe.profile)) {
    const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
    for (const Ring& ring : pair) {
      for (std::uint32_t i = 0; i <= lathe.segments; ++i) {
        const float turn = static_cast<float>(i) / static_cast<float>(lathe.segments);
        const float c = std::cos(turn * 2.0F * PI);
        const float s = i == lathe.segments ? 0.0F : std::sin(turn * 2.0F * PI);
        Vertex vertex;
        vertex.position = {ring.point.x * c, ring.point.y, -ring.point.x * s};
        vertex.normal = glm::normalize(glm::vec3(ring.normal.x * c, ring.normal.y, -ring.normal.x * s));
        vertex.tangent = glm::vec4(-s, 0.0F, -c, 1.0F);
        vertex.uv.fill({turn * around, ring.v});
        geometry.vertices.push_back(vertex);
      }
    }
    const std::uint32_t stride = lathe.segments + 1;
    for (std::uint32_t i = 0; i < lathe.segments; ++i) {
      const std::uint32_t a = first + i;
      if (pair[0].point.x > 0.0F) add_triangle(geometry, a, a + 1, a + stride + 1);
      if (pair[1].point.x > 0.0F) add_triangle(geometry, a, a + stride + 1, a + stride);
    }
  }
}

void add_cylinder(Geometry& geometry, float radius, float y0, float y1, std::uint32_t segments) {
  const std::array<glm::vec2, 4> profile{{{0, y0}, {radius, y0}, {radius, y1}, {0, y1}}};
  add_lathe(geometry, {.profile = profile, .segments = segments});
}

void add_sphere(Geometry& geometry, const glm::vec3& center, float radius, std::uint32_t segments) {
  std::vector<glm::vec2> profile;
  const std::uint32_t rows = std::max(4U, segments / 2);
  for (std::uint32_t i = 0; i <= rows; ++i) {
    const float angle = PI * (static_cast<float>(i) / static_cast<float>(rows) - 0.5F);
    const bool pole = i == 0 || i == rows;
    profile.emplace_back(pole ? 0.0F : radius * std::cos(angle), radius * std::sin(angle));
  }
  Geometry sphere;
  add_lathe(sphere, {.profile = profile, .segments = segments});
  append(geometry, sphere, at(center.x, center.y, center.z));
}

void add_tube(Geometry& geometry, const Tube& tube) {
  const std::size_t count = tube.path.size();
  const auto direction = [&](std::size_t i) {
    return glm::normalize(tube.path[std::min(i + 1, count - 1)] - tube.path[i > 0 ? i - 1 : 0]);
  };
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const std::uint32_t stride = tube.sides + 1;
  const glm::vec3 start = direction(0);
  glm::vec3 side = std::abs(start.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  float v = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 axis = direction(i);
    side = glm::normalize(side - axis * glm::dot(axis, side));
    const glm::vec3 other = glm::cross(axis, side);  // a turn from side to other is counter-clockwise around the axis
    if (i > 0) v -= glm::length(tube.path[i] - tube.path[i - 1]);
    for (std::uint32_t k = 0; k <= tube.sides; ++k) {
      const float turn = static_cast<float>(k % tube.sides) / static_cast<float>(tube.sides) * 2.0F * PI;
      Vertex vertex;
      vertex.normal = side * std::cos(turn) + other * std::sin(turn);
      vertex.position = tube.path[i] + vertex.normal * tube.radii[i];
      vertex.tangent = glm::vec4(other * std::cos(turn) - side * std::sin(turn), 1.0F);
      vertex.uv.fill({static_cast<float>(k) / static_cast<float>(tube.sides) * 2.0F * PI * tube.radii[0], v});
      geometry.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    for (std::uint32_t k = 0; k < tube.sides; ++k) {
      const std::uint32_t a = first + i * stride + k;
      add_triangle(geometry, a, a + 1, a + stride + 1);
      add_triangle(geometry, a, a + stride + 1, a + stride);
    }
  }
  std::vector<glm::vec3> bottom;
  std::vector<glm::vec3> top;
  for (std::uint32_t k = 0; k < tube.sides; ++k) {
    bottom.push_back(geometry.vertices[first + tube.sides - 1 - k].position);
    top.push_back(geometry.vertices[first + static_cast<std::uint32_t>(count - 1) * stride + k].position);
  }
  add_polygon(geometry, bottom);
  add_polygon(geometry, top);
}

void add_arch_wall(Geometry& geometry, const ArchWall& wall) {
  const float half = wall.width / 2.0F;
  const float z = wall.depth / 2.0F;
  // A piece of both faces: from (x0, low0 .. top) to (x1, low1 .. top), left to right.
  const auto strip = [&](float x0, float low0, float x1, float low1, float high) {
    add_quad(geometry, {x0, low0, z}, {x1, low1, z}, {x1, high, z}, {x0, high, z});
    add_quad(geometry, {x1, low1, -z}, {x0, low0, -z}, {x0, high, -z}, {x1, high, -z});
  };
  for (const float side : {-1.0F, 1.0F}) {
    const float x0 = side < 0.0F ? -half : wall.radius;
    const float x1 = side < 0.0F ? -wall.radius : half;
    strip(x0, wall.spring, x1, wall.spring, wall.top);
    if (wall.spring > wall.bottom) {
      strip(x0, wall.bottom, x1, wall.bottom, wall.spring);
      const float x = side * wall.radius;
      add_quad(geometry, {x, wall.bottom, -side * z}, {x, wall.bottom, side * z}, {x, wall.spring, side * z},
               {x, wall.spring, -side * z});
    }
    add_quad(geometry, {x0, wall.bottom, -z}, {x1, wall.bottom, -z}, {x1, wall.bottom, z}, {x0, wall.bottom, z});
  }
  const auto arc = [&](std::uint32_t i) {
    const float angle = PI * (1.0F - static_cast<float>(i) / static_cast<float>(wall.segments));
    if (i == 0) return glm::vec2(-wall.radius, wall.spring);
    if (i == wall.segments) return glm::vec2(wall.radius, wall.spring);
    return glm::vec2(wall.radius * std::cos(angle), wall.spring + wall.radius * std::sin(angle));
  };
  for (std::uint32_t i = 0; i < wall.segments; ++i) {
    strip(arc(i).x, arc(i).y, arc(i + 1).x, arc(i + 1).y, wall.top);
  }
  // The underside of the arch, seen from below: right is along the arc from its right foot to its left.
  add_grid(
      geometry,
      {.columns = wall.segments, .rows = 1, .size_m = {PI * wall.radius, wall.depth}, .surface = [&](glm::vec2 uv) {
         const float angle = PI * uv.x;
         return glm::vec3(wall.radius * std::cos(angle), wall.spring + wall.radius * std::sin(angle),
                          z - wall.depth * uv.y);
       }});
}

void add_arch_ring(Geometry& geometry, const ArchRing& ring) {
  const float z = ring.depth / 2.0F;
  const auto on_arc = [&](float radius, float along, float depth) {
    const float angle = PI * along;
    return glm::vec3(radius * std::cos(angle), ring.spring + radius * std::sin(angle), depth);
  };
  const float middle = PI * (ring.inner + ring.outer) / 2.0F;
  const float thick = ring.outer - ring.inner;
  const auto side = [&](float across, std::function<glm::vec3(glm::vec2)> surface) {
    add_grid(geometry,
             {.columns = ring.segments, .rows = 1, .size_m = {middle, across}, .surface = std::move(surface)});
  };
  side(ring.depth, [&](glm::vec2 uv) { return on_arc(ring.inner, uv.x, z - ring.depth * uv.y); });
  side(ring.depth, [&](glm::vec2 uv) { return on_arc(ring.outer, 1.0F - uv.x, z - ring.depth * uv.y); });
  side(thick, [&](glm::vec2 uv) { return on_arc(ring.inner + thick * uv.y, 1.0F - uv.x, z); });
  side(thick, [&](glm::vec2 uv) { return on_arc(ring.inner + thick * uv.y, uv.x, -z); });
  for (const float sign : {-1.0F, 1.0F}) {
    const float x0 = sign < 0.0F ? -ring.outer : ring.inner;
    const float x1 = sign < 0.0F ? -ring.inner : ring.outer;
    add_quad(geometry, {x0, ring.spring, -z}, {x1, ring.spring, -z}, {x1, ring.spring, z}, {x0, ring.spring, z});
  }
}

}  // namespace lamp::app::procedural
