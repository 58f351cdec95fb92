// Dots, rings and edges of lights; edges of decals.
// SPDX-License-Identifier: Apache-2.0
#include "view/light_marks.h"

#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

#include "view/picture_lines.h"

namespace lamp::app {
namespace {

constexpr float DOT_PX = 3.0F;

ImU32 mark_color(const shared::Light& light, float alpha) {
  const glm::vec3 intensity = light.intensity;
  const glm::vec3 color = intensity / std::max({intensity.r, intensity.g, intensity.b, 1e-6F});
  return ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, alpha));
}

void draw_cone(const PictureLines& lines, const shared::Light& light, const Ink& ink) {
  const glm::vec3 apex_at = light.position;
  const glm::vec3 axis = light.direction;
  const glm::vec3 side = std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
  const glm::vec3 u = glm::normalize(glm::cross(axis, side));
  const glm::vec3 v = glm::cross(axis, u);
  const float along = light.range * std::cos(light.outer_angle);
  const float across = light.range * std::sin(light.outer_angle);
  lines.ring({.center = apex_at + along * axis, .u = across * u, .v = across * v}, ink);
  for (const glm::vec3& edge : {u, -u, v, -v}) lines.line(apex_at, apex_at + along * axis + across * edge, ink);
}

bool has_outline(const shared::Light& light) { return std::isfinite(light.range) && light.range < 1e6F; }

void draw_outline(const PictureLines& lines, const shared::Light& light, const Ink& ink) {
  if (light.type == shared::LIGHT_SPOT) return draw_cone(lines, light, ink);
  if (const auto outline = outline_of_sphere(lines.view(), light.position, light.range)) lines.ring(*outline, ink);
}

/// True if the light is in sight.
bool draw_light(const PictureLines& lines, const shared::Light& light, bool outlined) {
  if (outlined && has_outline(light)) draw_outline(lines, light, {.color = mark_color(light, 0.6F)});
  const auto at = lines.at(light.position);
  if (!at) return false;
  lines.draw().AddCircleFilled(*at, DOT_PX, mark_color(light, 1.0F), 8);
  lines.draw().AddCircle(*at, DOT_PX + 1.0F, IM_COL32(0, 0, 0, 160), 8);
  return true;
}

/// Stands out from any picture, and a point light's sphere is one: three circles of it, too.
void draw_looked_at(const PictureLines& lines, const shared::Light& light) {
  for (const Ink& ink : {Ink{IM_COL32(0, 0, 0, 180), 4.0F}, Ink{mark_color(light, 1.0F), 2.0F}}) {
    if (!has_outline(light)) break;
    draw_outline(lines, light, ink);
    if (light.type == shared::LIGHT_SPOT) continue;
    const glm::mat3 axes(light.range);
    for (int i = 0; i < 3; ++i)
      lines.ring({.center = light.position, .u = axes[i], .v = axes[(i + 1) % 3]}, {ink.color, 0.5F * ink.width});
  }
  draw_light(lines, light, false);
  if (const auto at = lines.at(light.position)) lines.draw().AddCircle(*at, 3.0F * DOT_PX, IM_COL32_WHITE, 16, 2.0F);
}

}  // namespace

void draw_light_marks(LightMarks which, const Shown& shown, const ScreenRect& picture) {
  const bool one = shown.state.light && *shown.state.light < shown.lights->size();
  if (which == LightMarks::none && !one) return;
  const PictureLines lines(shown.view, picture);
  if (which == LightMarks::cell && shown.inspection) {
    for (const ListedLight& light : shown.inspection->lights) draw_light(lines, shown.lights->all()[light.light], true);
  } else if (which == LightMarks::all) {
    constexpr std::size_t MOST_OUTLINED = 256;  // more are a tangle
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < shown.lights->size() && drawn < MOST_MARKS; ++i)
      drawn += draw_light(lines, shown.lights->all()[i], shown.lights->size() <= MOST_OUTLINED) ? 1 : 0;
  }
  if (one) draw_looked_at(lines, shown.lights->all()[*shown.state.light]);
}

glm::mat3 axes_of(const shared::OrientedBox& box) {
  return {box.half_extents.x * glm::vec3(box.axis_x), box.half_extents.y * glm::vec3(box.axis_y),
          box.half_extents.z * glm::vec3(box.axis_z)};
}

void draw_decal_boxes(const Shown& shown, const ScreenRect& picture) {
  const PictureLines lines(shown.view, picture);
  for (const shared::OrientedBox& box : shown.decals)
    lines.box(box.center, axes_of(box), {.color = IM_COL32(120, 255, 160, 200)});
}

}  // namespace lamp::app
