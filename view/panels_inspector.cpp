// The pixel that was picked: why each light is in its cell, and whether one is missing.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/panels.h"

namespace lamp::app {
namespace {

void draw_lights(const Inspection& found) {
  constexpr ImGuiTableFlags FLAGS = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  const float height =
      ImGui::GetFontSize() * 1.4F * static_cast<float>(std::clamp<std::size_t>(found.lights.size() + 2, 3, 14));
  if (!ImGui::BeginTable("lights of the cell", 6, FLAGS, {0.0F, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* title : {"light", "type", "dist.", "range", "share", "why it is listed"})
    ImGui::TableSetupColumn(title);
  ImGui::TableHeadersRow();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(found.lights.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const ListedLight& light = found.lights[static_cast<std::size_t>(i)];
      const auto cell = [](const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
      };
      cell(fmt::format("{}", light.light));
      cell(light.spot ? "spot" : "point");
      cell(fmt::format("{:.2f}", light.distance_m));
      cell(fmt::format("{:.2f}", light.range_m));
      cell(fmt::format("{:.1f}%", 100.0 * light.share));
      cell(why_listed(light));
    }
  }
  ImGui::EndTable();
}

void draw_inspection(const Inspection& found, const Stats& stats) {
  if (found.sky) {
    Widgets::text(fmt::format("Pixel ({}, {}) shows the sky, which no light reaches.", found.pixel.x, found.pixel.y));
    return;
  }
  const auto reaching = std::ranges::count(found.lights, Reach::inside, &ListedLight::reach);
  Widgets::row("pixel", fmt::format("({}, {}), {:.2f} m ahead", found.pixel.x, found.pixel.y, found.z_view));
  Widgets::row("surface",
               fmt::format("({:.2f}, {:.2f}, {:.2f}) m", found.position.x, found.position.y, found.position.z));
  Widgets::row("cell", fmt::format("{} of {}: {} pixels, {:.2f} to {:.2f} m", found.cell, stats.cells,
                                   found.cell_pixels, found.cell_near_m, found.cell_far_m));
  Widgets::row("lights", fmt::format("{} listed, {} reach the pixel", found.lights.size(), reaching));
  Widgets::row("the cell", words_of(found.proof));
  draw_lights(found);
}

}  // namespace

void inspector_window(const Shown& shown, Widgets& widgets, ViewState& state, const ScreenRect& area, float scale) {
  if (!shown.inspection) return;
  const float width = std::min(560.0F * scale, static_cast<float>(area.size().x));
  ImGui::SetNextWindowPos({static_cast<float>(area.max.x), static_cast<float>(area.min.y)}, ImGuiCond_Appearing,
                          {1.0F, 0.0F});
  ImGui::SetNextWindowSize({width, 0.0F}, ImGuiCond_Appearing);
  ImGui::SetNextWindowBgAlpha(0.9F);
  constexpr ImGuiWindowFlags FLAGS = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("Inspector", nullptr, FLAGS)) {
    draw_inspection(*shown.inspection, shown.first.stats);
    if (widgets.button("look away", "Forgets the pixel. Escape does the same.")) state.picked.reset();
  }
  ImGui::End();
}

void proof_panel(PanelFrame& p) {
  if (!p.widgets.header("Proof", true)) return;
  if (!p.shown.inspection)
    Widgets::note("Click a pixel of the picture to see its cell, and why each light is listed there.");
  if (p.widgets.button("prove the picture", "Holds the list of every pixel against the oracle, in double precision.",
                       p.proving ? "it is being done" : ""))
    p.wishes.prove = true;
  if (p.proving) ImGui::ProgressBar(p.progress);
  if (p.proof) Widgets::text(words_of(*p.proof));
}

}  // namespace lamp::app
