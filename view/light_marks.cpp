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
constexpr int AROUND = 24;  // corners of a circle

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
  /// A closed line through points around a centre, where all are ahead of the eye.
  void ring(const glm::vec3& center, const glm::vec3& u, const glm::vec3& v, ImU32 color) const {
    std::array<ImVec2, AROUND> corners;
    for (int i = 0; i < AROUND; ++i) {
      const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / AROUND;
      const auto corner = at(center + std::cos(angle) * u + std::sin(angle) * v);
      if (!corner) return;
      corners[static_cast<std::size_t>(i)] = *corner;
    }
    draw.AddPolyline(corners.data(), AROUND, color, ImDrawFlags_Closed, 1.0F);
  }
};

ImU32 mark_color(const shared::Light& light, float alpha) {
  const glm::vec3 intensity = light.intensity;
  const glm::vec3 color = intensity / std::max({intensity.r, intensity.g, intensity.b, 1e-6F});
  return ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, alpha));
}

void draw_cone(const Marks& marks, const shared::Light& light) {
  const glm::vec3 apex_at = light.position;
  const glm::vec3 axis = light.direction;
  const glm::vec3 side = std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
  const glm::vec3 u = glm::normalize(glm::cross(axis, side));
  const glm::vec3 v = glm::cross(axis, u);
  const float along = light.range * std::cos(light.outer_angle);
  const float across = light.range * std::sin(light.outer_angle);
  const ImU32 color = mark_color(light, 0.6F);
  marks.ring(apex_at + along * axis, across * u, across * v, color);
  const auto apex = marks.at(apex_at);
  for (const glm::vec3& edge : {u, -u, v, -v})
    if (const auto end = marks.at(apex_at + along * axis + across * edge); apex && end)
      marks.draw.AddLine(*apex, *end, color);
}

/// True if the light is in sight.
bool draw_light(const Marks& marks, const shared::Light& light, bool outlined) {
  const auto at = marks.at(light.position);
  if (outlined && std::isfinite(light.range) && light.range < 1e6F) {
    if (light.type == shared::LIGHT_SPOT) {
      draw_cone(marks, light);
    } else {
      const glm::mat3 world_from_view(glm::dmat4(marks.view.world_from_view()));
      marks.ring(light.position, light.range * world_from_view[0], light.range * world_from_view[1],
                 mark_color(light, 0.6F));
    }
  }
  if (!at) return false;
  marks.draw.AddCircleFilled(*at, DOT_PX, mark_color(light, 1.0F), 8);
  marks.draw.AddCircle(*at, DOT_PX + 1.0F, IM_COL32(0, 0, 0, 160), 8);
  return true;
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
  if (one) {
    const shared::Light& light = shown.lights->all()[*shown.state.light];
    draw_light(marks, light, true);
    if (const auto at = marks.at(light.position)) draw.AddCircle(*at, 3.0F * DOT_PX, IM_COL32_WHITE, 16, 2.0F);
  }
  draw.PopClipRect();
}

void draw_decal_boxes(const Shown& shown, const ScreenRect& picture) {
  ImDrawList& draw = clipped_to(picture);
  const Marks marks{.view = shown.view, .picture = picture, .draw = draw};
  for (const shared::OrientedBox& box : shown.decals) draw_box(marks, box);
  draw.PopClipRect();
}

}  // namespace lamp::app
