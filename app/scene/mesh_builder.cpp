// Flat parts and grids of procedural scenes, and the way into a Scene.
// Based on: nothing; planar maps and central differences.
// Promise: see the header; every face's corners are given counter-clockwise.
// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_builder.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace lamp::app::procedural {
namespace {

/// The horizontal direction in the plane of a face that is right of whoever faces it; for floors, +X.
glm::vec3 face_tangent(const glm::vec3& normal) {
  if (std::abs(normal.y) > 0.9F) return glm::normalize(glm::vec3(1, 0, 0) - normal * normal.x);
  return glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
}

Vertex make_vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec3& tangent, const glm::vec2& uv) {
  Vertex vertex;
  vertex.position = position;
  vertex.normal = normal;
  vertex.tangent = glm::vec4(tangent, 1.0F);
  vertex.uv = {uv, uv};
  return vertex;
}

void add_triangle(Geometry& geometry, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  geometry.indices.insert(geometry.indices.end(), {a, b, c});
}

/// The vertex of a grid at (u, v): its frame by differences, taken a little inside where the surface has a pole.
Vertex grid_vertex(const Grid& grid, glm::vec2 at_uv) {
  constexpr float STEP = 2e-3F;
  const auto difference = [&](glm::vec2 center, glm::vec2 step) {
    const glm::vec2 from = glm::clamp(center - step, 0.0F, 1.0F);
    const glm::vec2 to = glm::clamp(center + step, 0.0F, 1.0F);
    return grid.surface(to) - grid.surface(from);
  };
  const auto normal_at = [&](glm::vec2 center) {
    return glm::cross(difference(center, {STEP, 0}), difference(center, {0, STEP}));
  };
  const glm::vec2 inside = glm::mix(at_uv, glm::vec2(0.5F), 0.02F);
  const glm::vec3 normal_here = normal_at(at_uv);
  const glm::vec3 normal_inside = normal_at(inside);
  const bool pole = glm::length(normal_here) < 0.05F * glm::length(normal_inside);
  const glm::vec2 probe = pole ? inside : at_uv;
  const glm::vec3 normal = glm::normalize(pole ? normal_inside : normal_here);
  const glm::vec3 along_u = difference(probe, {STEP, 0});
  const glm::vec3 tangent = glm::normalize(along_u - normal * glm::dot(normal, along_u));
  return make_vertex(grid.surface(at_uv), normal, tangent, {at_uv.x * grid.size_m.x, (1.0F - at_uv.y) * grid.size_m.y});
}

}  // namespace

void add_polygon(Geometry& geometry, std::span<const glm::vec3> corners) {
  glm::vec3 area{0.0F};  // Newell's normal: right for any planar polygon
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  const glm::vec3 normal = glm::normalize(area);
  const glm::vec3 tangent = face_tangent(normal);
  const glm::vec3 up = glm::cross(normal, tangent);
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  for (const glm::vec3& corner : corners) {
    geometry.vertices.push_back(
        make_vertex(corner, normal, tangent, {glm::dot(corner, tangent), -glm::dot(corner, up)}));
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) add_triangle(geometry, first, first + i - 1, first + i);
}

void add_quad(Geometry& geometry, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  add_polygon(geometry, std::array{a, b, c, d});
}

void add_uv_quad(Geometry& geometry, const UvQuad& quad) {
  const glm::vec3 normal = glm::normalize(glm::cross(quad.right, quad.up));
  const glm::vec3 tangent = glm::normalize(quad.right);
  const glm::vec2 size{glm::length(quad.right), glm::length(quad.up)};
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  for (const glm::vec2 f : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    geometry.vertices.push_back(make_vertex(quad.corner + quad.right * f.x + quad.up * f.y, normal, tangent,
                                            quad.uv + glm::vec2(f.x, -f.y) * size));
  }
  add_triangle(geometry, first, first + 1, first + 2);
  add_triangle(geometry, first, first + 2, first + 3);
}

void add_box(Geometry& geometry, const glm::vec3& min, const glm::vec3& max) {
  const auto corner = [&](int x, int y, int z) {
    return glm::vec3(x != 0 ? max.x : min.x, y != 0 ? max.y : min.y, z != 0 ? max.z : min.z);
  };
  add_quad(geometry, corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
  add_quad(geometry, corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
  add_quad(geometry, corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
  add_quad(geometry, corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
  add_quad(geometry, corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
  add_quad(geometry, corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
}

void add_frame(Geometry& geometry, const Frame& frame) {
  constexpr std::array<glm::vec2, 4> CORNERS{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};  // counter-clockwise from above
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [](glm::vec2 sign, glm::vec2 half, float y) {
      return glm::vec3(sign.x * half.x, y, sign.y * half.y);
    };
    const glm::vec2 a = CORNERS[i];
    const glm::vec2 b = CORNERS[(i + 1) % 4];
    const auto outer = [&](glm::vec2 s, glm::vec2 y) { return corner(s, frame.outer, y.y); };
    const auto inner = [&](glm::vec2 s, glm::vec2 y) { return corner(s, frame.inner, y.x); };
    add_quad(geometry, outer(a, frame.top), outer(b, frame.top), inner(b, frame.top), inner(a, frame.top));
    add_quad(geometry, inner(a, frame.bottom), inner(b, frame.bottom), outer(b, frame.bottom), outer(a, frame.bottom));
    add_quad(geometry, outer(a, frame.bottom), outer(b, frame.bottom), outer(b, frame.top), outer(a, frame.top));
    add_quad(geometry, inner(b, frame.bottom), inner(a, frame.bottom), inner(a, frame.top), inner(b, frame.top));
  }
}

void add_prism(Geometry& geometry, std::span<const glm::vec2> outline, float z0, float z1) {
  glm::vec2 center{0.0F};
  for (const glm::vec2& point : outline) center += point / static_cast<float>(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::vec2 a = outline[i];
    const glm::vec2 b = outline[(i + 1) % outline.size()];
    add_quad(geometry, {a, z1}, {a, z0}, {b, z0}, {b, z1});
    add_polygon(geometry, std::array{glm::vec3(center, z1), glm::vec3(a, z1), glm::vec3(b, z1)});
    add_polygon(geometry, std::array{glm::vec3(center, z0), glm::vec3(b, z0), glm::vec3(a, z0)});
  }
}

void add_grid(Geometry& geometry, const Grid& grid) {
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  for (std::uint32_t row = 0; row <= grid.rows; ++row) {
    for (std::uint32_t column = 0; column <= grid.columns; ++column) {
      const glm::vec2 cell(static_cast<float>(column) / static_cast<float>(grid.columns),
                           static_cast<float>(row) / static_cast<float>(grid.rows));
      geometry.vertices.push_back(grid_vertex(grid, cell));
    }
  }
  const std::uint32_t stride = grid.columns + 1;
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const std::uint32_t a = first + row * stride + column;
      add_triangle(geometry, a, a + 1, a + stride + 1);
      add_triangle(geometry, a, a + stride + 1, a + stride);
    }
  }
}

void append(Geometry& geometry, const Geometry& part, const glm::mat4& transform) {
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  const glm::mat3 linear(transform);
  for (Vertex vertex : part.vertices) {
    vertex.position = glm::vec3(transform * glm::vec4(vertex.position, 1.0F));
    vertex.normal = glm::normalize(linear * vertex.normal);
    vertex.tangent = glm::vec4(glm::normalize(linear * glm::vec3(vertex.tangent)), vertex.tangent.w);
    geometry.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : part.indices) geometry.indices.push_back(first + index);
}

void tint(Geometry& geometry, const glm::vec3& color) {
  for (Vertex& vertex : geometry.vertices) {
    const glm::vec3 product = glm::vec3(vertex.color) * glm::clamp(color, 0.0F, 1.0F);
    vertex.color = glm::u8vec4(glm::u8vec3(product + 0.5F), vertex.color.a);
  }
}

glm::mat4 at(float x, float y, float z) { return glm::translate(glm::mat4(1.0F), glm::vec3(x, y, z)); }

glm::mat4 at(const glm::vec3& position, float turn_y, float scale) {
  const glm::mat4 moved = glm::translate(glm::mat4(1.0F), position);
  return glm::scale(glm::rotate(moved, turn_y, glm::vec3(0, 1, 0)), glm::vec3(scale));
}

std::uint32_t add_mesh(Scene& scene, const Geometry& geometry, std::uint32_t material) {
  scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()),
                          .index_count = static_cast<std::uint32_t>(geometry.indices.size()),
                          .vertex_offset = static_cast<std::uint32_t>(scene.vertices.size()),
                          .material = material});
  scene.vertices.insert(scene.vertices.end(), geometry.vertices.begin(), geometry.vertices.end());
  scene.indices.insert(scene.indices.end(), geometry.indices.begin(), geometry.indices.end());
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void place(Scene& scene, std::uint32_t mesh, const glm::mat4& world_from_object) {
  scene.instances.push_back({.mesh = mesh, .world_from_object = world_from_object});
}

void add_once(Scene& scene, const Geometry& geometry, std::uint32_t material) {
  place(scene, add_mesh(scene, geometry, material), glm::mat4(1.0F));
}

}  // namespace lamp::app::procedural
