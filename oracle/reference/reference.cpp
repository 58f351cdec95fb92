// The oracle, the slow way: the definition of "an entity reaches a position", and the truth that follows from it.
// Based on: the contract in reference.h; Kahan's atan2 form of the angle, which stays exact near 0 and 90 degrees.
// Promise: double precision throughout; no bounds, no cells, no code of any method.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/reference.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace lamp {
namespace {

// How a measure (distance or angle) stands to its limit.
Reach compare(double measure, double limit) {
  if (std::abs(measure - limit) <= BOUNDARY_BAND * limit) return Reach::boundary;
  return measure < limit ? Reach::inside : Reach::outside;
}

Reach reach_of_range(const shared::Light& light, double distance_squared) {
  const double range = light.range;
  if (!(range > 0.0)) return Reach::outside;
  if (light.range >= shared::INFINITE_RADIUS) return Reach::inside;
  // Nearly every pair ends here, without a square root; the factor clears the boundary band.
  if (distance_squared > range * range * 1.001) return Reach::outside;
  return compare(std::sqrt(distance_squared), range);
}

Reach reach_of_cone(const shared::Light& light, const glm::dvec3& from_light) {
  const double outer = light.outer_angle;
  if (!(outer > 0.0)) return Reach::outside;
  if (from_light == glm::dvec3(0.0)) return Reach::boundary;  // at the light's own position there is no angle
  // The length of the direction cancels, so its 32-bit rounding matters only to where it points.
  const glm::dvec3 direction(light.direction);
  const double angle = std::atan2(glm::length(glm::cross(direction, from_light)), glm::dot(direction, from_light));
  return compare(angle, outer);
}

void append(Reach answer, std::uint32_t id, Truth& truth) {
  if (answer == Reach::inside) truth.lights.push_back(id);
  if (answer == Reach::boundary) ++truth.boundary_pairs;
}

glm::dvec3 local_of(const shared::OrientedBox& box, const glm::dvec3& position_world) {
  const glm::dvec3 from_center = position_world - glm::dvec3(box.center);
  return {glm::dot(glm::dvec3(box.axis_x), from_center), glm::dot(glm::dvec3(box.axis_y), from_center),
          glm::dot(glm::dvec3(box.axis_z), from_center)};
}

void append_pixel(const TruthQuery& query, const glm::dvec3& position_world, Truth& truth) {
  const auto first_box = query.first_id + static_cast<std::uint32_t>(query.lights.size());
  for (std::uint32_t i = 0; i < query.lights.size(); ++i)
    append(reach(query.lights[i], position_world), query.first_id + i, truth);
  for (std::uint32_t i = 0; i < query.boxes.size(); ++i)
    append(reach(query.boxes[i], shape_of(query, i), position_world), first_box + i, truth);
  assert(truth.lights.size() <= std::numeric_limits<std::uint32_t>::max() && "too many pairs: ask for fewer rows");
}

}  // namespace

Reach reach(const shared::Light& light, const glm::dvec3& position_world) {
  const glm::dvec3 from_light = position_world - glm::dvec3(light.position);
  const Reach by_range = reach_of_range(light, glm::dot(from_light, from_light));
  if (by_range == Reach::outside || light.type == shared::LIGHT_POINT) return by_range;
  const Reach by_cone = reach_of_cone(light, from_light);
  if (by_cone == Reach::outside) return by_cone;
  return by_range == Reach::inside ? by_cone : Reach::boundary;
}

Reach reach(const shared::OrientedBox& box, const glm::dvec3& position_world) {
  const glm::dvec3 local = local_of(box, position_world);
  const glm::dvec3 half(box.half_extents);
  Reach answer = Reach::inside;
  for (int i = 0; i < 3; ++i) {
    const Reach along = compare(std::abs(local[i]), half[i]);
    if (along == Reach::outside) return along;
    if (along == Reach::boundary) answer = along;
  }
  return answer;
}

Reach reach(const shared::OrientedBox& box, EntityShape shape, const glm::dvec3& position_world) {
  if (shape == EntityShape::box) return reach(box, position_world);
  return compare(glm::length(local_of(box, position_world) / glm::dvec3(box.half_extents)), 1.0);
}

EntityShape shape_of(const TruthQuery& query, std::size_t box) {
  return query.shapes.empty() ? EntityShape::box : query.shapes[box];
}

Truth brute_force_truth(const TruthQuery& query) {
  const View& view = query.view;
  assert(query.depth.size() == std::size_t{view.width()} * view.height() && "depth must cover the whole picture");
  assert(query.first_row <= view.height() && query.rows <= view.height() - query.first_row &&
         "rows beyond the picture");

  Truth truth{.first_row = query.first_row, .rows = query.rows, .offsets = {0}};
  for (std::uint32_t y = query.first_row; y < query.first_row + query.rows; ++y) {
    for (std::uint32_t x = 0; x < view.width(); ++x) {
      const double depth = query.depth[std::size_t{y} * view.width() + x];
      if (depth != view.sky_depth()) append_pixel(query, view.world_position(x, y, depth), truth);
      truth.offsets.push_back(static_cast<std::uint32_t>(truth.lights.size()));
    }
  }
  return truth;
}

}  // namespace lamp
