// Projects lights.
// SPDX-License-Identifier: Apache-2.0
#include "view/light_marks.h"

#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lamp::app {
namespace {

constexpr float DOT_PX = 3.0F;
constexpr int AROUND = 48;  // corners of a circle

struct Ink {
  ImU32 color = IM_COL32_WHITE;
  float width = 1.0F;
};

struct Marks {
  const View& view;
  const ScreenRect& picture;
  ImDrawList& draw;

  [[nodiscard]] std::optional<ImVec2> at(const glm::vec3& position) const {
    const auto place = place_in_picture(view, position);
    if (!place) return std::nullopt;
    const glm::vec2 px = glm::vec2(picture.min) + *place * glm::vec2(picture.size());
    return ImVec2(px.x, px.y);
  }
  /// A closed line through points around a centre, as far as they are ahead of the eye.
  void ring(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v, const Ink& ink) const {
    std::array<std::optional<ImVec2>, AROUND> corners;
    for (int i = 0; i < AROUND; ++i) {
      const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / AROUND;
      corners[static_cast<std::size_t>(i)] = at(center + std::cos(angle) * u + std::sin(angle) * v);
    }
    for (std::size_t i = 0; i < AROUND; ++i)
      if (const auto &from = corners[i], &to = corners[(i + 1) % AROUND]; from && to)
        draw.AddLine(*from, *to, ink.color, ink.width);
  }
};

ImU32 mark_color(const shared::Light& light, float alpha) {
  const glm::vec3 intensity = light.intensity;
  const glm::vec3 color = intensity / std::max({intensity.r, intensity.g, intensity.b, 1e-6F});
  return ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, alpha));
}

void draw_cone(const Marks& marks, const shared::Light& light, const Ink& ink) {
  const glm::vec3 apex_at = light.position;
  const glm::vec3 axis = light.direction;
  const glm::vec3 side = std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
  const glm::vec3 u = glm::normalize(glm::cross(axis, side));
  const glm::vec3 v = glm::cross(axis, u);
  const float along = light.range * std::cos(light.outer_angle);
  const float across = light.range * std::sin(light.outer_angle);
  marks.ring(apex_at + along * axis, across * u, across * v, ink);
  const auto apex = marks.at(apex_at);
  for (const glm::vec3& edge : {u, -u, v, -v})
    if (const auto end = marks.at(apex_at + along * axis + across * edge); apex && end)
      marks.draw.AddLine(*apex, *end, ink.color, ink.width);
}

bool has_outline(const shared::Light& light) { return std::isfinite(light.range) && light.range < 1e6F; }

void draw_outline(const Marks& marks, const shared::Light& light, const Ink& ink) {
  if (light.type == shared::LIGHT_SPOT) return draw_cone(marks, light, ink);
  const glm::mat3 world_from_view(glm::dmat4(marks.view.world_from_view()));
  marks.ring(light.position, light.range * world_from_view[0], light.range * world_from_view[1], ink);
}

/// True if the light is in sight.
bool draw_light(const Marks& marks, const shared::Light& light, bool outlined) {
  if (outlined && has_outline(light)) draw_outline(marks, light, {.color = mark_color(light, 0.6F)});
  const auto at = marks.at(light.position);
  if (!at) return false;
  marks.draw.AddCircleFilled(*at, DOT_PX, mark_color(light, 1.0F), 8);
  marks.draw.AddCircle(*at, DOT_PX + 1.0F, IM_COL32(0, 0, 0, 160), 8);
  return true;
}

/// Stands out from any picture, and a point light's sphere is one: three circles of it, too.
void draw_looked_at(const Marks& marks, const shared::Light& light) {
  for (const Ink& ink : {Ink{IM_COL32(0, 0, 0, 180), 4.0F}, Ink{mark_color(light, 1.0F), 2.0F}}) {
    if (!has_outline(light)) break;
    draw_outline(marks, light, ink);
    if (light.type == shared::LIGHT_SPOT) continue;
    const glm::mat3 axes(light.range);
    for (int i = 0; i < 3; ++i) marks.ring(light.position, axes[i], axes[(i + 1) % 3], {ink.color, 0.5F * ink.width});
  }
  draw_light(marks, light, false);
  if (const auto at = marks.at(light.position)) marks.draw.AddCircle(*at, 3.0F * DOT_PX, IM_COL32_WHITE, 16, 2.0F);
}

/// To be popped by the caller.
ImDrawList& clipped_to(const ScreenRect& picture) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({static_cast<float>(picture.min.x), static_cast<float>(picture.min.y)},
                    {static_cast<float>(picture.max.x), static_cast<float>(picture.max.y)});
  return draw;
}

void draw_box(const Marks& marks, const shared::OrientedBox& box) {
  const glm::vec3 axes[] = {box.half_extents.x * glm::vec3(box.axis_x), box.half_extents.y * glm::vec3(box.axis_y),
                            box.half_extents.z * glm::vec3(box.axis_z)};
  const auto corner = [&](std::uint32_t number) {
    glm::vec3 at = box.center;
    for (std::uint32_t axis = 0; axis < 3; ++axis) at += (number >> axis & 1U) != 0 ? axes[axis] : -axes[axis];
    return marks.at(at);
  };
  for (std::uint32_t from = 0; from < 8; ++from)
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      if ((from >> axis & 1U) != 0) continue;
      const auto a = corner(from);
      const auto b = corner(from | 1U << axis);
      if (a && b) marks.draw.AddLine(*a, *b, IM_COL32(120, 255, 160, 200), 1.0F);
    }
}

}  // namespace

std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& position) {
  const glm::dvec4 clip =
      glm::dmat4(view.clip_from_view()) * glm::dmat4(view.view_from_world()) * glm::dvec4(position, 1.0);
  if (!(clip.w > 1e-6) || clip.z > clip.w) return std::nullopt;
  return glm::vec2(0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w);
}

void draw_light_marks(LightMarks which, const Shown& shown, const ScreenRect& picture) {
  const bool one = shown.state.light && *shown.state.light < shown.lights->size();
  if (which == LightMarks::none && !one) return;
  ImDrawList& draw = clipped_to(picture);
  const Marks marks{.view = shown.view, .picture = picture, .draw = draw};
  if (which == LightMarks::cell && shown.inspection) {
    for (const ListedLight& light : shown.inspection->lights) draw_light(marks, shown.lights->all()[light.light], true);
  } else if (which == LightMarks::all) {
    constexpr std::size_t MOST_OUTLINED = 256;  // more are a tangle
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < shown.lights->size() && drawn < MOST_MARKS; ++i)
      drawn += draw_light(marks, shown.lights->all()[i], shown.lights->size() <= MOST_OUTLINED) ? 1 : 0;
  }
  if (one) draw_looked_at(marks, shown.lights->all()[*shown.state.light]);
  draw.PopClipRect();
}

void draw_decal_boxes(const Shown& shown, const ScreenRect& picture) {
  ImDrawList& draw = clipped_to(picture);
  const Marks marks{.view = shown.view, .picture = picture, .draw = draw};
  for (const shared::OrientedBox& box : shown.decals) draw_box(marks, box);
  draw.PopClipRect();
}

}  // namespace lamp::app
