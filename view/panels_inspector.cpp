// The pixel that was picked: why each light is in its cell, and whether one is missing.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/light_cells.h"
#include "view/mask_overlay.h"
#include "view/panels.h"
#include "view/shape_lines.h"
#include "view/world_boxes.h"

namespace lamp::app {
namespace {

void draw_inspection(InspectorFrame& p) {
  const Shown& shown = p.shown;
  const Inspection& found = *shown.inspection;
  const Stats& stats = shown.inspected_side().stats;
  if (shown.second) Widgets::row("side", fmt::format("{}: {}", found.second ? "B" : "A", words_of_method(stats)));
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
  list_of_lights(p);
  Widgets::note(
      "Click a row: its light is shown in the picture, and can be changed. Point at a reason: it is explained. Tests "
      "see the cell's pixels; the method's own cell may be larger.");
  mask_of_cell(found);
  light_editor(p);
  cells_of_light(p.state, p.widgets);
  shadow_of_light(shown, p.state, p.widgets);
}

/// A window that an area which shrank no longer holds comes back into it.
void bring_back(const ScreenRect& area) {
  const glm::vec2 at(ImGui::GetWindowPos().x, ImGui::GetWindowPos().y);
  const glm::vec2 size(ImGui::GetWindowWidth(), ImGui::GetWindowHeight());
  const glm::vec2 within = glm::max(glm::vec2(area.min), glm::min(at, glm::vec2(area.max) - size));
  ImGui::SetWindowPos({within.x, within.y});
}

}  // namespace

void inspector_window(InspectorFrame& p, const ScreenRect& area, float scale) {
  if (!p.shown.inspection) return;
  const glm::vec2 room(area.size());
  const float width = std::min(640.0F * scale, room.x);
  const float most_height = std::max(100.0F * scale, 0.5F * room.x * room.y / width);  // over half of the picture
  // Where the pixel is not.
  const bool is_left = p.shown.inspection->pixel.x >= p.shown.view.width() / 2;
  ImGui::SetNextWindowPos({static_cast<float>(is_left ? area.min.x : area.max.x), static_cast<float>(area.min.y)},
                          ImGuiCond_Appearing, {is_left ? 0.0F : 1.0F, 0.0F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, std::min(most_height, room.y)});
  ImGui::SetNextWindowSize({width, 0.0F});  // as high as it needs
  ImGui::SetNextWindowBgAlpha(0.9F);
  const bool open = ImGui::Begin("Inspector", nullptr, ImGuiWindowFlags_NoFocusOnAppearing);
  if (std::exchange(p.scroll.area, area) != area && !ImGui::IsWindowAppearing()) bring_back(area);
  if (open) {
    draw_inspection(p);
    if (p.widgets.button("look away", "Forgets the pixel. Escape does the same.")) p.state.picked.reset();
    ImGui::SameLine();
    p.widgets.check("hold time", p.state.paused,
                    "Lights stand still, and so do this list and the picture's size, until the camera moves. The space "
                    "bar does the same.");
    if (!p.shown.inspection->sky) {
      ImGui::SameLine();
      if (p.widgets.button(
              "ask other methods",
              "What every method of the table would list for this pixel: a method of the picture with the options "
              "that are set, all others with their default options.",
              p.asking ? "they are being asked" : ""))
        p.wishes.ask = true;
      lists_of_others(p);
    }
  }
  ImGui::End();
}

void proof_panel(PanelFrame& p) {
  if (!p.widgets.header("Proof", true)) return;
  if (p.widgets.button("prove the picture",
                       "Holds the list of every pixel that shows a surface against the oracle: all lights that reach "
                       "it, found on the CPU in double precision. With a second method, the lists of both.",
                       p.proving ? "it is being done" : ""))
    p.wishes.prove = true;
  const int lines = p.state.against ? 5 : 3;  // whichever it says, so that what is below stays where it is
  Widgets::steady(lines, [&] {
    if (p.proving) return ImGui::ProgressBar(p.progress);
    if (!p.proof.empty()) return Widgets::text(p.proof);
    Widgets::note(p.shown.inspection ? "The cell of the picked pixel is proved with every picture, in the inspector."
                                     : "Click a pixel of the picture to see its cell, and why each light is listed.");
  });
}

}  // namespace lamp::app
