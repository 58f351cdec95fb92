// The pixel that was picked: why each light is in its cell, and whether one is missing.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

#include "view/panels.h"
#include "view/shape_lines.h"
#include "view/world_boxes.h"

namespace lamp::app {
namespace {

void draw_rows(const Inspection& found, ViewState& state, Widgets& widgets) {
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(found.lights.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const ListedLight& light = found.lights[static_cast<std::size_t>(i)];
      const auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
      };
      ImGui::TableNextColumn();
      if (widgets.pick(fmt::format("{}", light.light), state.light == light.light)) state.light = light.light;
      cell(light.spot ? "spot" : "point");
      cell(fmt::format("{:.2f}", light.distance_m));
      cell(fmt::format("{:.2f}", light.range_m));
      cell(fmt::format("{:.1f}%", 100.0 * light.share));
      cell(why_listed(light, found.tests_of(light)));
      if (ImGui::IsItemHovered()) Widgets::tip(explained(light, found.tests_of(light)));
    }
  }
}

/// In a part of its own that scrolls: a table that scrolls by itself ends the program (an assertion of ImGui 1.86)
/// where nothing of it is in sight.
void draw_lights(const Inspection& found, ViewState& state, Widgets& widgets) {
  constexpr ImGuiTableFlags FLAGS = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
  const float height = ImGui::GetTextLineHeightWithSpacing() *
                       static_cast<float>(std::clamp<std::size_t>(found.lights.size() + 2, 3, 16));
  if (ImGui::BeginChild("lights", {0.0F, height}) && ImGui::BeginTable("lights of the cell", 6, FLAGS)) {
    for (const char* title : {"light", "type", "dist.", "range", "share"}) ImGui::TableSetupColumn(title);
    ImGui::TableSetupColumn("why it is listed", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    draw_rows(found, state, widgets);
    ImGui::EndTable();
  }
  ImGui::EndChild();
}

/// The light that was picked: what is changed becomes an edit of the state.
void edit_light(const Shown& shown, ViewState& state, Widgets& widgets) {
  if (!state.light || *state.light >= shown.lights->size()) return;
  const std::uint32_t number = *state.light;
  const auto found = std::ranges::find(state.edits, number, &LightEdit::light);
  Light light = found != state.edits.end() ? found->value : unpacked(shown.lights->all()[number]);
  const float step = 0.01F * std::clamp(light.range, 0.1F, 100.0F);
  Widgets::text(fmt::format("light {}, a {} light", number, light.type == LightType::spot ? "spot" : "point"));
  bool changed = widgets.move("position", light.position, step, "Where it is, metres. Drag a number.");
  if (std::isfinite(light.range))
    changed = widgets.slide("its range", light.range, {.min = 0.01, .max = 1000.0, .logarithmic = true},
                            "How far it reaches, metres.") ||
              changed;
  changed = widgets.color("color", light.color, "Its colour, linear.") || changed;
  changed = widgets.slide("intensity", light.intensity, {.min = 0.001, .max = 1e5, .logarithmic = true},
                          "How bright it is, candela.") ||
            changed;
  if (light.type == LightType::spot) {
    changed = widgets.move("direction", light.direction, 0.01F, "Where it looks.") || changed;
    if (widgets.slide("outer angle", light.outer_angle, {.min = 0.01, .max = 1.57},
                      "Half of its cone's angle, radians.")) {
      light.inner_angle = std::min(light.inner_angle, light.outer_angle);
      changed = true;
    }
  }
  if (light.direction == glm::vec3(0.0F)) return;
  if (changed && found != state.edits.end()) found->value = light;
  if (changed && found == state.edits.end()) state.edits.push_back({.light = number, .value = light});
}

void draw_others(std::span<const OtherList> others) {
  const float height = ImGui::GetTextLineHeightWithSpacing() * 8.0F;
  if (ImGui::BeginChild("others", {0.0F, height}, /* border= */ true) && ImGui::BeginTable("what others list", 2)) {
    for (const OtherList& list : others) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(list.method.c_str());
      ImGui::TableNextColumn();
      const std::string words = list.refused.empty()
                                    ? fmt::format("{} lights, {} reach the pixel", list.lights, list.reaching)
                                    : list.refused;
      ImGui::TextUnformatted(words.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
}

void draw_inspection(const Shown& shown, ViewState& state, Widgets& widgets) {
  const Inspection& found = *shown.inspection;
  const Stats& stats = shown.first.stats;
  if (found.sky) {
    Widgets::text(fmt::format("Pixel ({}, {}) shows the sky, which no light reaches.", found.pixel.x, found.pixel.y));
    return;
  }
  const auto reaching = std::ranges::count(found.lights, Reach::inside, &ListedLight::reach);
  Widgets::row("pixel", fmt::format("({}, {}) of {}x{}, {:.2f} m ahead", found.pixel.x, found.pixel.y,
                                    shown.view.width(), shown.view.height(), found.z_view));
  Widgets::row("surface",
               fmt::format("({:.2f}, {:.2f}, {:.2f}) m", found.position.x, found.position.y, found.position.z));
  Widgets::row("cell", fmt::format("{} of {}: {} pixels, {:.2f} to {:.2f} m", found.cell, stats.cells,
                                   found.cell_pixels, found.cell_near_m, found.cell_far_m));
  Widgets::row("lights", fmt::format("{} listed, {} reach the pixel", found.lights.size(), reaching));
  Widgets::row("the cell", words_of(found.proof));
  world_of_point(shown);
  probes_of_pixel(shown);
  draw_lights(found, state, widgets);
  Widgets::note(
      "Click a row: its light is shown in the picture, and can be changed. Point at a reason: it is explained. Tests "
      "see the cell's pixels; the method's own cell may be larger.");
  edit_light(shown, state, widgets);
  shadow_of_light(shown, state, widgets);
}

}  // namespace

void inspector_window(InspectorFrame& p, const ScreenRect& area, float scale) {
  if (!p.shown.inspection) return;
  const float width = std::min(640.0F * scale, static_cast<float>(area.size().x));
  // Where the pixel is not.
  const bool is_left = p.shown.inspection->pixel.x >= p.shown.view.width() / 2;
  ImGui::SetNextWindowPos({static_cast<float>(is_left ? area.min.x : area.max.x), static_cast<float>(area.min.y)},
                          ImGuiCond_Appearing, {is_left ? 0.0F : 1.0F, 0.0F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, static_cast<float>(area.size().y)});
  ImGui::SetNextWindowSize({width, 0.0F});  // as high as it needs
  ImGui::SetNextWindowBgAlpha(0.9F);
  constexpr ImGuiWindowFlags FLAGS = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("Inspector", nullptr, FLAGS)) {
    draw_inspection(p.shown, p.state, p.widgets);
    if (p.widgets.button("look away", "Forgets the pixel. Escape does the same.")) p.state.picked.reset();
    ImGui::SameLine();
    p.widgets.check("hold time", p.state.paused,
                    "Lights stand still, and so does this list. The space bar does the same.");
    if (!p.shown.inspection->sky) {
      ImGui::SameLine();
      if (p.widgets.button("ask other methods", "What every method of the table would list for this pixel.",
                           p.asking ? "they are being asked" : ""))
        p.wishes.ask = true;
      if (!p.others.empty()) draw_others(p.others);
    }
  }
  ImGui::End();
}

void proof_panel(PanelFrame& p) {
  if (!p.widgets.header("Proof", true)) return;
  if (!p.shown.inspection)
    Widgets::note("Click a pixel of the picture to see its cell, and why each light is listed there.");
  if (p.widgets.button("prove the picture",
                       "Holds the list of every pixel that shows a surface against the oracle: all lights that reach "
                       "it, found on the CPU in double precision.",
                       p.proving ? "it is being done" : ""))
    p.wishes.prove = true;
  if (p.proving) ImGui::ProgressBar(p.progress);
  if (p.proof) Widgets::text(words_of(*p.proof));
}

}  // namespace lamp::app
