// Sphere and cone against a polygon: the nearest point of the cone's section with the plane, or else of its edges.
// Based on: a cone of at most 90 degrees and a sphere are convex, so the point of their section nearest to the light
// lies straight ahead, on the cone, or on an edge of the polygon.
// SPDX-License-Identifier: Apache-2.0
#include "still_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lamplight/light.h"

namespace lamp::world {
namespace {

constexpr double ROUNDED = 1e-6;  // share of a range, and radians of a cone: rounding of 32-bit numbers
constexpr double ON_EDGE =
    1e-9;  // share of a length by which a place may be beyond an edge or a cone and counts as in it
constexpr double IN_PLANE = 1e-12;  // m before a plane that is none
constexpr double INFINITE = std::numeric_limits<double>::infinity();

/// A sphere and a cone of one apex.
struct Sector {
  glm::dvec3 apex;
  glm::dvec3 axis;
  double cosine;
  double sine;
  double range;
};

bool in_cone(const Sector& s, const glm::dvec3& from_apex) {
  const double length = glm::length(from_apex);
  return glm::dot(s.axis, from_apex) >= (s.cosine - ON_EDGE) * length;
}

bool holds(const Sector& s, const glm::dvec3& place) {
  const glm::dvec3 from_apex = place - s.apex;
  return glm::dot(from_apex, from_apex) <= s.range * s.range && in_cone(s, from_apex);
}

double share_nearest(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& place) {
  const double length2 = glm::dot(way, way);
  return length2 > 0.0 ? std::clamp(glm::dot(place - from, way) / length2, 0.0, 1.0) : 0.0;
}

bool is_inside(const Polygon& polygon, const glm::dvec3& plane, const glm::dvec3& place) {
  double sign = 0.0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec3& a = polygon.corners[i].at;
    const glm::dvec3 edge = polygon.corners[(i + 1) % polygon.count].at - a;
    const glm::dvec3 to = place - a;
    const double side = glm::dot(plane, glm::cross(edge, to));
    if (std::abs(side) <= ON_EDGE * glm::length(edge) * (glm::length(edge) + glm::length(to))) continue;
    if (side * sign < 0.0) return false;
    sign = side;
  }
  return true;
}

double distance2(const Polygon& polygon, const glm::dvec3& plane, const glm::dvec3& place) {
  const double height = glm::dot(plane, place - polygon.corners[0].at);
  if (plane != glm::dvec3(0.0) && is_inside(polygon, plane, place - plane * height)) return height * height;
  double least = INFINITE;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec3& a = polygon.corners[i].at;
    const glm::dvec3 way = polygon.corners[(i + 1) % polygon.count].at - a;
    const glm::dvec3 to = a + share_nearest(a, way, place) * way - place;
    least = std::min(least, glm::dot(to, to));
  }
  return least;
}

bool is_within(const Polygon& polygon, const glm::dvec3& plane, const glm::dvec3& place, double range) {
  for (const Corner& corner : polygon.all())  // mostly one is
    if (glm::dot(corner.at - place, corner.at - place) <= range * range) return true;
  return distance2(polygon, plane, place) <= range * range;
}

/// Of an edge's points in the cone, the one nearest to the apex is where the edge is nearest, or where it meets the
/// cone, or at one of its ends, which `meets` looks at.
bool meets_edge(const Sector& s, const glm::dvec3& from, const glm::dvec3& way) {
  const glm::dvec3 v = from - s.apex;
  const double cosine2 = s.cosine * s.cosine;
  const double dv = glm::dot(s.axis, v);
  const double dw = glm::dot(s.axis, way);
  const double a = dw * dw - cosine2 * glm::dot(way, way);
  const double half_b = dv * dw - cosine2 * glm::dot(v, way);
  const double c = dv * dv - cosine2 * glm::dot(v, v);
  const auto at = [&](double share) { return share >= 0.0 && share <= 1.0 && holds(s, from + share * way); };
  if (at(share_nearest(from, way, s.apex))) return true;
  const double discriminant = std::sqrt(std::max(half_b * half_b - a * c, 0.0));
  const double q = -(half_b + std::copysign(discriminant, half_b));
  return (a != 0.0 && at(q / a)) || (q != 0.0 && at(c / q));
}

/// The unit vector in the cone that comes nearest to another.
glm::dvec3 nearest_in_cone(const Sector& s, const glm::dvec3& to) {
  const double along = glm::dot(s.axis, to);
  if (along >= s.cosine) return to;
  const glm::dvec3 across = to - along * s.axis;
  const double length = glm::length(across);
  return length > 0.0 ? s.axis * s.cosine + across * (s.sine / length) : s.axis;
}

bool meets(const Sector& s, const Polygon& polygon, glm::dvec3 plane) {
  for (const Corner& corner : polygon.all())  // mostly one is
    if (holds(s, corner.at)) return true;
  if (plane != glm::dvec3(0.0)) {
    double height = glm::dot(plane, polygon.corners[0].at - s.apex);
    if (height < 0.0) {
      plane = -plane;
      height = -height;
    }
    const glm::dvec3 ahead = nearest_in_cone(s, plane);
    const double towards = glm::dot(plane, ahead);
    const double way = height <= IN_PLANE ? 0.0 : towards > 0.0 ? height / towards : INFINITE;
    if (way < INFINITE && is_inside(polygon, plane, s.apex + ahead * way)) return way <= s.range;
  }
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const glm::dvec3& a = polygon.corners[i].at;
    if (meets_edge(s, a, polygon.corners[(i + 1) % polygon.count].at - a)) return true;
  }
  return false;
}

}  // namespace

Bounds bounds_of(const Polygon& polygon) {
  Bounds box{glm::dvec3(INFINITE), glm::dvec3(-INFINITE)};
  for (const Corner& corner : polygon.all()) {
    box.min = glm::min(box.min, corner.at);
    box.max = glm::max(box.max, corner.at);
  }
  return box;
}

Polygon cut(const Polygon& polygon, int axis, double sign, double limit) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Corner& a = polygon.corners[i];
    const Corner& b = polygon.corners[(i + 1) % polygon.count];
    const double of_a = sign * a.at[axis] - limit;
    const double of_b = sign * b.at[axis] - limit;
    if (of_a <= 0.0) kept.add(a);
    if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0)) {
      const double share = of_a / (of_a - of_b);
      Corner between{glm::mix(a.at, b.at, share), glm::mix(a.normal, b.normal, share)};
      between.at[axis] = sign * limit;
      kept.add(between);
    }
  }
  return kept;
}

StillLight still_light(const shared::Light& light) {
  StillLight still{.position = glm::dvec3(light.position), .range = light.range * (1.0 + ROUNDED)};
  if (light.range >= shared::INFINITE_RADIUS) still.range = INFINITE;
  const shared::LightSphere sphere = bounding_sphere(light);
  still.center = glm::dvec3(sphere.center);
  still.radius = sphere.radius;
  if (!(light.range > 0.0F)) still.radius = -1.0;
  if (still.radius >= 0.0)
    still.radius = still.range == INFINITE ? INFINITE : still.radius + 4.0 * ROUNDED * still.range;
  if (light.type != shared::LIGHT_SPOT) return still;
  still.spot = true;
  if (!(light.outer_angle > 0.0F)) still.radius = -1.0;
  still.axis = glm::normalize(glm::dvec3(light.direction));
  const double angle = std::min(light.outer_angle + ROUNDED, std::numbers::pi / 2.0);
  still.cosine = std::cos(angle);
  still.sine = std::sin(angle);
  return still;
}

bool may_touch(const StillLight& light, const Bounds& box, double slack) {
  if (light.radius < 0.0) return false;
  const glm::dvec3 gap = glm::max(glm::max(box.min - light.center, light.center - box.max), glm::dvec3(0.0));
  const double radius = light.radius + slack;
  if (glm::dot(gap, gap) > radius * radius) return false;
  if (!light.spot) return true;
  const glm::dvec3 to = 0.5 * (box.min + box.max) - light.position;
  const double along = glm::dot(light.axis, to);
  const double beside = glm::length(to - along * light.axis) * light.cosine - along * light.sine;
  return beside <= 0.5 * glm::length(box.max - box.min) + slack + ON_EDGE * glm::length(to);
}

bool touches(const StillLight& light, const Polygon& polygon, const glm::dvec3& plane, double slack) {
  if (light.radius < 0.0 || polygon.count == 0) return false;
  const double range = light.range + slack;
  if (!is_within(polygon, plane, light.position, range)) return false;
  if (!light.spot) return true;
  // A cone whose apex is moved back encloses all that is within the slack of it.
  const double back = slack / light.sine;
  if (back > 0.5 * range) return true;
  return meets({.apex = light.position - light.axis * back,
                .axis = light.axis,
                .cosine = light.cosine,
                .sine = light.sine,
                .range = range + back},
               polygon, plane);
}

bool is_behind(const StillLight& light, const Polygon& polygon, double tilt, double slack) {
  if (tilt >= std::numbers::pi / 2.0) return false;
  for (const Corner& corner : polygon.all())  // mostly one is before it
    if (glm::dot(light.position - corner.at, corner.normal) > 0.0) return false;
  double farthest = 0.0;
  double longest = 0.0;
  for (const Corner& corner : polygon.all()) {
    farthest = std::max(farthest, glm::length(light.position - corner.at));
    longest = std::max(longest, glm::length(corner.normal));
  }
  farthest = std::min(farthest, light.range) + slack;
  const double limit = -longest * ((std::sin(tilt) + 1e-5) * farthest + slack);
  // (light - position) . normal is a quadratic form of a position's weights: below the limit where these are.
  for (const Corner& a : polygon.all())
    for (const Corner& b : polygon.all())
      if (0.5 * (glm::dot(light.position - a.at, b.normal) + glm::dot(light.position - b.at, a.normal)) > limit)
        return false;
  return longest > 0.0;
}

}  // namespace lamp::world
