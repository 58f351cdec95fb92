// How large a view shows a sphere.
// Promise: 0 only if no point of the sphere lies in the picture.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "lamplight/shadow_atlas.h"

namespace lamp {
namespace {

// Of the sizes that go in: what the rounding of this arithmetic and of the bounds' 32 bits may take away.
constexpr double ROOM = 1e-6;

glm::dvec4 row(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

/// Whether a sphere lies wholly on the wrong side of an edge of the picture.
bool beyond(const glm::dvec4& plane, const glm::dvec3& center, double radius) {
  return glm::dot(glm::dvec3(plane), center) + plane.w < -radius * glm::length(glm::dvec3(plane));
}

/// `w` grows by one a metre ahead, or is 1 all over.
glm::dmat4 with_usual_w(const glm::dmat4& m) { return m / (m[2][3] == 0.0 ? m[3][3] : -m[2][3]); }

/// Where w is 0 and both sides of the picture meet, of a perspective.
glm::dvec3 eye_of(const glm::dmat4& m) {
  const double z = m[3][3];
  return {-(m[2][0] * z + m[3][0]) / m[0][0], -(m[2][1] * z + m[3][1]) / m[1][1], z};
}

/// Whether any of it may be; `ahead` of the eye, metres.
bool in_picture(const glm::dmat4& m, const glm::dvec3& center, double ahead, double radius) {
  const glm::dvec4 w = row(m, 3);
  const std::array planes{w + row(m, 0), w - row(m, 0), w + row(m, 1), w - row(m, 1)};
  if (std::ranges::any_of(planes, [&](const glm::dvec4& plane) { return beyond(plane, center, radius); })) return false;
  return m[2][3] == 0.0 || ahead > -radius;  // behind the eye all four planes are right for nothing
}

}  // namespace

double shown_diameter_px(const View& view, const shared::LightSphere& sphere) {
  if (!(sphere.radius >= 0.0F)) return 0.0;
  const double longer = std::max(view.width(), view.height());
  if (sphere.radius >= shared::INFINITE_RADIUS) return longer;
  const glm::dmat4 m = with_usual_w(view.clip_from_view());
  const glm::dvec3 center(glm::dmat4(view.view_from_world()) * glm::dvec4(glm::dvec3(sphere.center), 1.0));
  const double radius =
      double{sphere.radius} * (1.0 + view.stretch()) + ROOM * (double{sphere.radius} + glm::length(center));
  if (!std::isfinite(radius)) return 0.0;  // it is nowhere
  const glm::dvec3 from_eye = view.orthographic() ? center : center - eye_of(m);
  if (!in_picture(m, center, -from_eye.z, radius)) return 0.0;
  const double px_per_slope = std::max(std::abs(m[0][0]) * view.width(), std::abs(m[1][1]) * view.height()) * 0.5;
  if (view.orthographic()) return std::min(longer, 2.0 * radius * px_per_slope);
  const double to_edge = glm::dot(from_eye, from_eye) - radius * radius;
  if (to_edge <= radius * radius * 1e-6) return longer;  // the eye is inside, or nearly
  return std::min(longer, 2.0 * radius / std::sqrt(to_edge) * px_per_slope);
}

}  // namespace lamp
