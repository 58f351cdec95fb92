// Edges of triangles as lines; texels as little rectangles.
// SPDX-License-Identifier: Apache-2.0
#include "view/shape_lines.h"

#include <fmt/format.h>
#include <imgui.h>

#include <tuple>

#include "view/picture_lines.h"

namespace lamp::app {
namespace {

constexpr ImU32 OUTSIDE = IM_COL32(255, 255, 255, 110);
constexpr ImU32 INSIDE = IM_COL32(255, 160, 40, 110);
constexpr ImU32 CUT = IM_COL32(90, 255, 140, 110);
constexpr ImU32 OF_SHADOW = IM_COL32(120, 200, 255, 160);

/// Of two triangles that share an edge one draws it: each has it the other way round.
bool is_first(const glm::vec3& a, const glm::vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

void draw_shape(const PictureLines& lines, const LightShape& shape, ImU32 color, bool closed) {
  for (std::size_t i = 0; i + 2 < shape.corners.size(); i += 3)
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const glm::vec3& a = shape.corners[i + edge];
      const glm::vec3& b = shape.corners[i + (edge + 1) % 3];
      if (!closed || is_first(a, b)) lines.line(a, b, {.color = color});
    }
}

void draw_square(std::span<const std::uint32_t> texels, std::uint32_t side, float size) {
  const ImVec2 min = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float step = size / static_cast<float>(side);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const ImVec2 at(min.x + step * static_cast<float>(x), min.y + step * static_cast<float>(y));
      draw.AddRectFilled(at, {at.x + step, at.y + step}, texels[x + std::size_t{side} * y]);
    }
  ImGui::Dummy({size, size});
}

}  // namespace

void draw_light_shapes(const Shown& shown, const ScreenRect& picture) {
  const PictureLines lines(shown.view, picture);
  if (shown.proxies)
    for (const LightShape& shape : shown.proxies->shapes)
      draw_shape(lines, shape, shape.cut ? CUT : shape.inside ? INSIDE : OUTSIDE, true);
  if (shown.shadow) draw_shape(lines, shown.shadow->shape, OF_SHADOW, shown.state.shadow_shape == ShadowShape::mesh);
}

void shadow_of_light(const Shown& shown, ViewState& state, Widgets& widgets) {
  if (!shown.shadow) return;
  const ShownShadow& shadow = *shown.shadow;
  if (shadow.squares.empty()) {
    Widgets::note(fmt::format("light {} has no shadow map", shadow.light));
    return;
  }
  Widgets::text(fmt::format("its shadow map: {} of {} texels a side; near is bright; frames since it was drawn: {}",
                            shadow.squares.size() == 1 ? "one square" : "six squares", shadow.map.side, shadow.age));
  widgets.choose_word("shadow's shape", state.shadow_shape, shadow_shape_names(),
                      "Drawn around the light: how far it reaches by direction, or the mesh that it is cut to.");
  if (state.shadow_shape != ShadowShape::none && shadow.shape.corners.empty())
    Widgets::note("The map does not bound what the light reaches.");
  constexpr std::size_t A_ROW = 6;
  const float size = (ImGui::GetContentRegionAvail().x - 40.0F) / static_cast<float>(A_ROW);
  for (std::size_t i = 0; i < shadow.squares.size(); ++i) {
    if (i % A_ROW != 0) ImGui::SameLine(0.0F, 4.0F);
    draw_square(shadow.squares[i], shadow.side, shadow.squares.size() == 1 ? 2.0F * size : size);
  }
}

}  // namespace lamp::app
