// Shadow maps of lights, the views that they are drawn by, and where they hold a point.
// Based on: the octahedral map and its folds: Cigolle et al., A Survey of Efficient Representations for Independent
// Unit Vectors, JCGT 3:2 (2014); bases: Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6:1 (2017).
// Promise: what a view draws at a texel is what `shadow_place` looks up there.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "../is_finite.h"
#include "lamplight/shadow_atlas.h"

namespace lamp {
namespace {

// Nearer than a hundredth of a small light's range, or a centimetre, nothing casts a shadow that its size would show.
constexpr float NEAR_M = 0.01F;
constexpr float NEAR_SHARE = 0.01F;
constexpr float NARROWEST = 1e-6F;  // radians, of a spot's map: the inverse of narrower ones is beyond all numbers

// Texels by which octants overlap. Rasterization snaps corners to 1/256 texel, and the folds run through texel centres:
// without it a texel on a fold might belong to neither side.
constexpr double OCTANT_OVERLAP = 0.02;

struct Rows {
  glm::dvec3 x, y, w;
};

glm::dvec3 axis(std::uint32_t i) {
  glm::dvec3 v(0.0);
  v[static_cast<int>(i % 3)] = 1.0;
  return v;
}

Rows face_rows(std::uint32_t face) {
  return {axis(face / 2 + 1), axis(face / 2 + 2), (face % 2 == 0 ? 1.0 : -1.0) * axis(face / 2)};
}

glm::dvec3 octant_signs(std::uint32_t octant) {
  return {(octant & 1U) == 0 ? 1.0 : -1.0, (octant & 2U) == 0 ? 1.0 : -1.0, (octant & 4U) == 0 ? 1.0 : -1.0};
}

/// The lower half is folded outwards: p = (1 - |p.yx|) with the signs of p, which within an octant is linear over w.
Rows octant_rows(std::uint32_t octant) {
  const glm::dvec3 s = octant_signs(octant);
  if (s.z > 0.0) return {axis(0), axis(1), s};
  return {s.x * glm::dvec3(s.x, 0.0, s.z), s.y * glm::dvec3(0.0, s.y, s.z), s};
}

glm::vec3 any_right_angle(const glm::vec3& n) {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1.0F / (sign + n.z);
  return {1.0F + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

bool is_wide(const shared::Light& light) { return light.outer_angle > WIDEST_SPOT_SQUARE; }

glm::uvec2 square_at(const shared::ShadowMap& map, std::uint32_t i) {
  return glm::uvec2(map.squares[i] & 0xffffU, map.squares[i] >> 16U) * shared::LEAST_SQUARE;
}

/// A view of clip space with these rows, of which a square at `corner` is a part.
shared::ShadowView view_of(const shared::ShadowMap& map, const Rows& rows, const glm::uvec2& corner,
                           std::uint32_t atlas_size) {
  const double per_clip = 2.0 / atlas_size;
  const glm::dvec2 middle = (glm::dvec2(corner) + map.side * 0.5) * per_clip - 1.0;
  const double scale = map.scale * per_clip;
  return {.position = map.position,
          .near_m = map.near_m,
          .row_x = glm::vec3(scale * rows.x + middle.x * rows.w),
          .range_m = map.range_m,
          .row_y = glm::vec3(scale * rows.y + middle.y * rows.w),
          .row_w = glm::vec3(rows.w)};
}

void add_square(const shared::ShadowMap& map, std::uint32_t square, const Rows& rows, std::uint32_t atlas_size,
                std::uint32_t light, std::vector<shared::ShadowView>& views) {
  shared::ShadowView view = view_of(map, rows, square_at(map, square), atlas_size);
  view.light = light;
  view.view = square;
  const glm::dvec3 edge = rows.w * (map.side * 0.5 / map.scale);
  const std::array planes{edge - rows.x, edge + rows.x, edge - rows.y, edge + rows.y};
  for (std::size_t i = 0; i < planes.size(); ++i) view.planes[i] = glm::vec3(glm::normalize(planes[i]));
  views.push_back(view);
}

void add_octant(const shared::ShadowMap& map, std::uint32_t octant, std::uint32_t atlas_size, std::uint32_t light,
                std::vector<shared::ShadowView>& views) {
  const glm::dvec3 signs = octant_signs(octant);
  shared::ShadowView view = view_of(map, octant_rows(octant), square_at(map, 0), atlas_size);
  view.light = light;
  view.view = octant;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const glm::dvec3 side = signs[static_cast<int>(i % 3)] * axis(i);
    view.planes[i] = glm::vec3(glm::normalize(side + signs * (OCTANT_OVERLAP / map.scale)));
  }
  views.push_back(view);
}

/// |x| + |y| + |z| > 0 of a direction, and where the octahedron holds it: -1 .. 1.
glm::vec2 octahedral(const glm::vec3& rel, float w) {
  const glm::vec2 p = glm::vec2(rel) / w;
  if (rel.z >= 0.0F) return p;
  return {(1.0F - std::abs(p.y)) * std::copysign(1.0F, p.x), (1.0F - std::abs(p.x)) * std::copysign(1.0F, p.y)};
}

std::uint32_t face_of(const glm::vec3& rel) {
  const glm::vec3 a = glm::abs(rel);
  const std::uint32_t major = a.x >= a.y && a.x >= a.z ? 0U : a.y >= a.z ? 1U : 2U;
  return 2 * major + (rel[static_cast<int>(major)] < 0.0F ? 1U : 0U);
}

}  // namespace

std::uint32_t shadow_border(ShadowFilter filter, std::uint32_t side) {
  // One more than taps reach, for rounding. Below 64 texels they reach less far.
  switch (filter) {
    case ShadowFilter::hard:
      return 1;
    case ShadowFilter::pcf:
      return (side >= 64 ? 2 : 1) + 1;
    default:
      return 4 * (side >= 64 ? 3 : side >= 32 ? 1 : 0) + 1;
  }
}

std::uint32_t shadow_squares(const shared::Light& light, PointShadows points) {
  if (!(light.range > 0.0F) || light.intensity == Vec3{} || !is_finite(Vec3(light.position))) return 0;
  if (light.type == shared::LIGHT_SPOT) return light.outer_angle > 0.0F ? 1 : 0;
  return points == PointShadows::faces ? shared::SQUARES_A_LIGHT : 1;
}

shared::ShadowMap shadow_map(const shared::Light& light, const ShadowAtlasInfo& info, std::uint32_t side,
                             std::span<const UVec2> squares) {
  if (squares.empty()) return {};
  assert(squares.size() == shadow_squares(light, info.points) && "give a light as many squares as it has");
  const bool spot = light.type == shared::LIGHT_SPOT && !is_wide(light);
  const float half_inner = static_cast<float>(side) * 0.5F - static_cast<float>(shadow_border(info.filter, side));
  shared::ShadowMap map{.position = light.position,
                        .kind = spot                  ? shared::SHADOW_SPOT
                                : squares.size() == 1 ? shared::SHADOW_OCTAHEDRON
                                                      : shared::SHADOW_FACES,
                        .axis_x = any_right_angle(light.direction),
                        .scale = half_inner,
                        .axis_z = light.direction,
                        .near_m = std::clamp(light.range * NEAR_SHARE, std::numeric_limits<float>::min(), NEAR_M),
                        .range_m = light.range,
                        .side = side};
  if (spot) map.scale = half_inner / std::tan(std::max(light.outer_angle, NARROWEST));
  if (map.kind == shared::SHADOW_OCTAHEDRON) map.scale = static_cast<float>(side) * 0.5F;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const glm::uvec2 at = glm::uvec2(squares[i]) / shared::LEAST_SQUARE;
    map.squares[i] = at.x | at.y << 16U;
  }
  return map;
}

bool shadow_shows_all(const shared::ShadowMap& map, const shared::Light& light) {
  if (map.kind == shared::SHADOW_NONE || map.position != light.position || !(light.range <= map.range_m)) return false;
  if (map.kind != shared::SHADOW_SPOT) return true;
  const float half_side = static_cast<float>(map.side) * 0.5F;
  return light.type == shared::LIGHT_SPOT && map.axis_z == light.direction && light.cos_outer > 0.0F &&
         map.scale * light.sin_outer <= half_side * light.cos_outer;
}

void add_shadow_views(const shared::ShadowMap& map, std::uint32_t atlas_size, std::uint32_t light,
                      std::vector<shared::ShadowView>& views) {
  if (map.kind == shared::SHADOW_SPOT) {
    const glm::dvec3 x(map.axis_x);
    const glm::dvec3 z(map.axis_z);
    add_square(map, 0, {x, glm::cross(z, x), z}, atlas_size, light, views);
  }
  for (std::uint32_t face = 0; map.kind == shared::SHADOW_FACES && face < shared::SQUARES_A_LIGHT; ++face)
    add_square(map, face, face_rows(face), atlas_size, light, views);
  for (std::uint32_t octant = 0; map.kind == shared::SHADOW_OCTAHEDRON && octant < shared::VIEWS_A_LIGHT; ++octant)
    add_octant(map, octant, atlas_size, light, views);
}

ShadowSquare shadow_viewport(const shared::ShadowMap& map, const shared::ShadowView& view) {
  if (map.kind != shared::SHADOW_OCTAHEDRON) return {.corner = square_at(map, view.view), .side = map.side};
  const std::uint32_t half = map.side / 2;
  const glm::uvec2 quarter((view.view & 1U) == 0 ? half : 0, (view.view & 2U) == 0 ? half : 0);
  return {.corner = square_at(map, 0) + quarter, .side = half};
}

shared::ShadowView shadow_view_in(const shared::ShadowView& view, const ShadowSquare& viewport,
                                  std::uint32_t atlas_size) {
  const double side = viewport.side;
  const double of_clip = side / atlas_size;
  const glm::dvec2 middle = (2.0 * glm::dvec2(glm::uvec2(viewport.corner)) + side) / double(atlas_size) - 1.0;
  const glm::dvec3 w{glm::vec3(view.row_w)};
  shared::ShadowView own = view;
  own.row_x = glm::vec3((glm::dvec3{glm::vec3(view.row_x)} - middle.x * w) / of_clip);
  own.row_y = glm::vec3((glm::dvec3{glm::vec3(view.row_y)} - middle.y * w) / of_clip);
  return own;
}

ShadowPlace shadow_place(const shared::ShadowMap& map, const Vec3& world) {
  const glm::vec3 axis_x = map.axis_x;
  const glm::vec3 axis_z = map.axis_z;
  const glm::vec3 rel = glm::vec3(world) - glm::vec3(map.position);
  ShadowPlace place;
  glm::vec2 p(0.0F);
  if (map.kind == shared::SHADOW_SPOT) {
    place.w = glm::dot(axis_z, rel);
    p = glm::vec2(glm::dot(axis_x, rel), glm::dot(glm::cross(axis_z, axis_x), rel)) / place.w;
  } else if (map.kind == shared::SHADOW_FACES) {
    place.square = face_of(rel);
    const int major = static_cast<int>(place.square / 2);
    place.w = std::abs(rel[major]);
    p = glm::vec2(rel[(major + 1) % 3], rel[(major + 2) % 3]) / place.w;
  } else if (map.kind == shared::SHADOW_OCTAHEDRON) {
    place.w = std::abs(rel.x) + std::abs(rel.y) + std::abs(rel.z);
    p = octahedral(rel, place.w);
  }
  if (!(place.w > 0.0F)) return {};
  place.texel = glm::vec2(square_at(map, place.square)) + static_cast<float>(map.side) * 0.5F + p * map.scale;
  return place;
}

}  // namespace lamp
