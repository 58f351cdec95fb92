// Boxes among the lights: their check, and the spheres and shapes that stand for them.
// Promise: the sphere holds the box's corners with room for the rounding of a 32-bit containment test, and so does the
// record's shape, however far the axes are from right angles within their tolerance.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/entity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "is_finite.h"
#include "light_faults.h"

namespace lamp {
namespace {

// Rounding of a containment test is some 1e-6 of a box; bounds of lights add what positions far from 0 lose.
constexpr double BOUND_ROOM = 1.0 + 1e-4;
constexpr float AXIS_TOLERANCE = 1e-4F;

std::string fault(const shared::OrientedBox& box) {
  if (!is_finite(box.center)) return expected("center must be finite", box.center);
  const Vec3& half = box.half_extents;
  if (!is_finite(half) || half.x <= 0.0F || half.y <= 0.0F || half.z <= 0.0F)
    return expected("half extents must be finite and > 0 m", half);
  const std::array<glm::vec3, 3> axes{box.axis_x, box.axis_y, box.axis_z};
  for (std::size_t i = 0; i < 3; ++i) {
    const float length = glm::dot(axes[i], axes[i]);
    const float across = glm::dot(axes[i], axes[(i + 1) % 3]);
    if (!(std::abs(length - 1.0F) <= AXIS_TOLERANCE) || !(std::abs(across) <= AXIS_TOLERANCE))
      return "axes must be unit and at right angles";
  }
  return {};
}

// Of the largest half extent. A thinner plate is culled as one of this thickness: 32-bit numbers tell it no better.
constexpr double THINNEST = 1e-7;
// What rounding half extents to 32 bits may take from them, and what containment tests add.
constexpr double SHAPE_ROOM = 1.0 + 1e-6;

/// The axes, right-handed: a mirrored box is the same box with one axis the other way.
glm::dmat3 turning_axes(const shared::OrientedBox& box) {
  glm::dmat3 axes(glm::dvec3(glm::vec3(box.axis_x)), glm::dvec3(glm::vec3(box.axis_y)),
                  glm::dvec3(glm::vec3(box.axis_z)));
  if (glm::determinant(axes) < 0.0) axes[2] = -axes[2];
  return axes;
}

/// A turn to the axes, which need not be quite at right angles, in 32 bits.
glm::quat turn_of(const glm::dmat3& axes) {
  const glm::dmat3 turned(axes[0], axes[1], glm::cross(axes[0], axes[1]));
  return glm::quat(glm::normalize(glm::quat_cast(turned)));
}

/// Half extents along the turned axes that enclose what `axes` and `half` say. What is written as |a_i . p| < h_i are
/// the points with p = A^-1 y, |y_i| < h_i.
glm::dvec3 enclosing_half_extents(const glm::dmat3& axes, const glm::dvec3& half, const glm::quat& turn,
                                  EntityShape shape) {
  const glm::dmat3 seen = glm::transpose(glm::mat3_cast(glm::dquat(turn))) * glm::inverse(glm::transpose(axes));
  glm::dvec3 box(0.0);
  double apart = 0.0;  // squared: how far the map from the unit ball to that of the record is from the identity
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      box[j] += std::abs(seen[i][j]) * half[i];
      const double off = seen[i][j] * half[i] / half[j] - (i == j ? 1.0 : 0.0);
      apart += off * off;
    }
  return shape == EntityShape::box ? box : half * (1.0 + std::sqrt(apart));
}

void write_shape(const shared::OrientedBox& box, EntityShape shape, shared::Light& record) {
  const glm::dmat3 axes = turning_axes(box);
  const glm::quat turn = turn_of(axes);
  const glm::dvec3 half(glm::vec3(box.half_extents));
  glm::dvec3 enclosing = enclosing_half_extents(axes, half, turn, shape) * SHAPE_ROOM;
  enclosing = glm::max(enclosing, glm::dvec3(THINNEST * std::max({half.x, half.y, half.z})));
  record.direction = glm::vec3(turn.x, turn.y, turn.z);
  record.outer_angle = turn.w;
  record.inner_angle = static_cast<float>(enclosing.x);
  record.cos_outer = static_cast<float>(enclosing.y);
  record.spot_scale = static_cast<float>(enclosing.z);
  record.sin_outer = shape == EntityShape::box ? shared::SHAPE_BOX : shared::SHAPE_ELLIPSOID;
}

}  // namespace

EntityRanges entity_ranges(std::uint32_t light_count, std::uint32_t box_count) {
  return entity_ranges(light_count, box_count, 0);
}

EntityRanges entity_ranges(std::uint32_t light_count, std::uint32_t decal_count, std::uint32_t probe_count) {
  const std::uint32_t first_probe = light_count + decal_count;
  const std::uint32_t end = first_probe + probe_count;
  return {.lights = {0, light_count},
          .boxes = {light_count, end},
          .decals = {light_count, first_probe},
          .probes = {first_probe, end}};
}

std::optional<Error> check_boxes(std::span<const shared::OrientedBox> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::string message = fault(boxes[i]);
    if (!message.empty()) return Error{"box " + std::to_string(i), std::move(message)};
  }
  return std::nullopt;
}

shared::Light bounding_light(const shared::OrientedBox& box) { return bounding_light(box, EntityShape::box); }

shared::Light bounding_light(const shared::OrientedBox& box, EntityShape shape) {
  const glm::dvec3 half(box.half_extents);
  const double radius = shape == EntityShape::box ? glm::length(half) : std::max({half.x, half.y, half.z});
  shared::Light record{};
  record.position = box.center;
  record.range = static_cast<float>(radius * BOUND_ROOM);
  record.type = shared::LIGHT_POINT;
  write_shape(box, shape, record);
  return record;
}

std::vector<shared::Light> entity_records(std::span<const shared::Light> lights,
                                          std::span<const shared::OrientedBox> boxes) {
  std::vector<shared::Light> records(lights.begin(), lights.end());
  records.reserve(lights.size() + boxes.size());
  for (const shared::OrientedBox& box : boxes) records.push_back(bounding_light(box));
  return records;
}

}  // namespace lamp
