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

template <class Entity>
void append_reaching(std::span<const Entity> entities, std::uint32_t id, const glm::dvec3& position, Truth& truth) {
  for (const Entity& entity : entities) {
    const Reach answer = reach(entity, position);
    if (answer == Reach::inside) truth.lights.push_back(id);
    if (answer == Reach::boundary) ++truth.boundary_pairs;
    ++id;
  }
}

void append_pixel(const TruthQuery& query, const glm::dvec3& position_world, Truth& truth) {
  const auto first_box = query.first_id + static_cast<std::uint32_t>(query.lights.size());
  append_reaching(query.lights, query.first_id, position_world, truth);
  append_reaching(query.boxes, first_box, position_world, truth);
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
  const glm::dvec3 from_center = position_world - glm::dvec3(box.center);
  const glm::dvec3 half(box.half_extents);
  Reach answer = Reach::inside;
  const std::array axes{box.axis_x, box.axis_y, box.axis_z};
  for (int i = 0; i < 3; ++i) {
    const Reach along =
        compare(std::abs(glm::dot(glm::dvec3(axes[static_cast<std::size_t>(i)]), from_center)), half[i]);
    if (along == Reach::outside) return along;
    if (along == Reach::boundary) answer = along;
  }
  return answer;
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
