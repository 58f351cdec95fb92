// Boxes among the lights: their check, and the spheres that stand for them.
// Promise: the sphere holds the box's corners with room for the rounding of a 32-bit containment test.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/entity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>

namespace lamp {
namespace {

// Rounding of a containment test is some 1e-6 of a box; bounds of lights add what positions far from 0 lose.
constexpr double BOUND_ROOM = 1.0 + 1e-4;
constexpr float AXIS_TOLERANCE = 1e-4F;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string fault(const shared::OrientedBox& box) {
  if (!finite(box.center)) return "center must be finite";
  const Vec3& half = box.half_extents;
  if (!finite(half) || half.x <= 0.0F || half.y <= 0.0F || half.z <= 0.0F)
    return "half extents must be finite and > 0 m, got (" + std::to_string(half.x) + ", " + std::to_string(half.y) +
           ", " + std::to_string(half.z) + ")";
  const std::array<glm::vec3, 3> axes{box.axis_x, box.axis_y, box.axis_z};
  for (std::size_t i = 0; i < 3; ++i) {
    const float length = glm::dot(axes[i], axes[i]);
    const float across = glm::dot(axes[i], axes[(i + 1) % 3]);
    if (!(std::abs(length - 1.0F) <= AXIS_TOLERANCE) || !(std::abs(across) <= AXIS_TOLERANCE))
      return "axes must be unit and at right angles";
  }
  return {};
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
  record.direction = {0.0F, 0.0F, -1.0F};
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
