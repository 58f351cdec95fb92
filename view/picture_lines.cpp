// Cuts lines in view space, before they are projected.
// SPDX-License-Identifier: Apache-2.0
#include "view/picture_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamp::app {
namespace {

constexpr int AROUND = 48;  // corners of a circle

/// Of the near plane, metres ahead of the eye.
double near_of(const View& view) { return view.z_view(view.reversed_depth() ? 1.0 : 0.0); }

glm::dvec3 seen(const View& view, const glm::vec3& position) {
  return {glm::dmat4(view.view_from_world()) * glm::dvec4(position, 1.0)};
}

glm::vec2 projected(const View& view, const glm::dvec3& of_view) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(of_view, 1.0);
  return {0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w};
}

}  // namespace

std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& position) {
  const glm::dvec3 at = seen(view, position);
  if (!(-at.z >= near_of(view))) return std::nullopt;
  return projected(view, at);
}

std::optional<std::pair<glm::vec2, glm::vec2>> line_in_picture(const View& view, const glm::vec3& from,
                                                               const glm::vec3& to) {
  const double near_m = near_of(view);
  glm::dvec3 ends[] = {seen(view, from), seen(view, to)};
  const double ahead[] = {-ends[0].z - near_m, -ends[1].z - near_m};
  if (ahead[0] < 0.0 && ahead[1] < 0.0) return std::nullopt;
  const glm::dvec3 cut = glm::mix(ends[0], ends[1], std::clamp(ahead[0] / (ahead[0] - ahead[1]), 0.0, 1.0));
  if (ahead[0] < 0.0) ends[0] = cut;
  if (ahead[1] < 0.0) ends[1] = cut;
  return std::pair(projected(view, ends[0]), projected(view, ends[1]));
}

std::optional<Circle> outline_of_sphere(const View& view, const glm::vec3& center, float radius) {
  const glm::dmat4 world_from_view(view.world_from_view());
  const glm::dvec3 right(world_from_view[0]);
  const glm::dvec3 up(world_from_view[1]);
  const double r = radius;
  if (view.orthographic()) return Circle{center, r * right, r * up};
  // Where lines from the eye touch the sphere.
  const glm::dvec3 away = glm::dvec3(center) - glm::dvec3(world_from_view[3]);
  const double distance = glm::length(away);
  if (!(distance > r)) return std::nullopt;
  const glm::dvec3 axis = away / distance;
  const glm::dvec3 side = std::abs(glm::dot(axis, up)) < 0.9 ? up : right;
  const glm::dvec3 u = glm::normalize(glm::cross(axis, side));
  const double of_circle = r * std::sqrt(1.0 - r * r / (distance * distance));
  return Circle{glm::dvec3(center) - axis * (r * r / distance), of_circle * u, of_circle * glm::cross(axis, u)};
}

PictureLines::PictureLines(const View& view, const ScreenRect& picture)
    : view_(view), picture_(picture), draw_(*ImGui::GetBackgroundDrawList()) {
  draw_.PushClipRect(on_screen({0.0F, 0.0F}), on_screen({1.0F, 1.0F}));
}

ImVec2 PictureLines::on_screen(const glm::vec2& place) const {
  const glm::vec2 px = glm::vec2(picture_.min) + place * glm::vec2(picture_.size());
  return {px.x, px.y};
}

std::optional<ImVec2> PictureLines::at(const glm::vec3& position) const {
  const auto place = place_in_picture(view_, position);
  return place ? std::optional(on_screen(*place)) : std::nullopt;
}

void PictureLines::line(const glm::vec3& from, const glm::vec3& to, const Ink& ink) const {
  if (const auto ends = line_in_picture(view_, from, to))
    draw_.AddLine(on_screen(ends->first), on_screen(ends->second), ink.color, ink.width);
}

void PictureLines::ring(const Circle& circle, const Ink& ink) const {
  const auto corner = [&](int number) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(number) / AROUND;
    return circle.center + std::cos(angle) * circle.u + std::sin(angle) * circle.v;
  };
  for (int i = 0; i < AROUND; ++i) line(corner(i), corner(i + 1), ink);
}

void PictureLines::box(const glm::vec3& center, const glm::mat3& axes, const Ink& ink) const {
  const auto corner = [&](int number) {
    glm::vec3 at = center;
    for (int axis = 0; axis < 3; ++axis) at += (number >> axis & 1) != 0 ? axes[axis] : -axes[axis];
    return at;
  };
  for (int from = 0; from < 8; ++from)
    for (int axis = 0; axis < 3; ++axis)
      if ((from >> axis & 1) == 0) line(corner(from), corner(from | 1 << axis), ink);
}

}  // namespace lamp::app
