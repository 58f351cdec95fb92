// Exposure, overlays and their legend.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "commands/pictures.h"
#include "commands/stats.h"
#include "render/heatmap_legend.h"
#include "view/light_cells.h"
#include "view/mask_overlay.h"
#include "view/panels.h"
#include "view/shadow_overlay.h"

namespace lamp::app {
namespace {

ImU32 color_of(glm::u8vec3 color) { return IM_COL32(color.r, color.g, color.b, 255); }

bool in_metres(Overlay overlay) { return overlay == Overlay::depth_range || overlay == Overlay::mask; }

/// The scale with numbers below it.
void draw_scale(const Legend& legend, Palette palette, float room) {
  constexpr int STEPS = 64;
  const float width = std::min(20.0F * ImGui::GetFontSize(), room);
  const float height = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int i = 0; i < STEPS; ++i) {
    const float left = at.x + width * static_cast<float>(i) / STEPS;
    const double position = (i + 0.5) / STEPS;
    draw.AddRectFilled({left, at.y}, {left + width / STEPS + 1.0F, at.y + height},
                       color_of(palette_color(palette, position)));
  }
  ImGui::Dummy({width, height});
  const auto number = [&](double share, const std::string& text) {
    const float x = static_cast<float>(share) * width - ImGui::CalcTextSize(text.c_str()).x * static_cast<float>(share);
    if (share > 0.0) ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + x, 0.0F);
    ImGui::TextUnformatted(text.c_str());
  };
  if (!in_metres(legend.overlay)) {
    const double middle = std::exp2(std::round(std::log2(legend.high) / 2.0));
    number(0.0, "1");
    number(heat_position(middle, static_cast<std::uint32_t>(legend.high)), fmt::format("{:.0f}", middle));
    number(1.0, fmt::format("{:.0f}", legend.high));
  } else {
    number(0.0, "0 m");
    number(1.0, fmt::format("{:.1f} m", legend.high));
  }
}

std::string words_of_shadow_heat(const char* what, const Legend& legend) {
  std::string words = fmt::format("{}: mean {:.1f}, max {:.0f}", what, legend.mean, legend.max);
  if (legend.cells != 0)
    words += fmt::format(
        "\n{} pixels are reached by a light without a shadow (magenta), or one whose shadow waits to be drawn anew "
        "(red)",
        legend.cells);
  return words;
}

std::string words_of_leaks(const LeakSums& sums) {
  std::string all;
  for (const std::string& words : {leak_words(sums), lost_words(sums), left_out_words(sums)})
    if (!words.empty()) all += (all.empty() ? "" : "\n") + words;
  return all;
}

/// What an overlay says of one side.
std::string words_of_side(const ShownSide& side, const ViewState& state) {
  const Legend& legend = side.legend;
  if (!legend.refused.empty()) return legend.refused;
  switch (legend.overlay) {
    case Overlay::heat:
      return fmt::format("lights that a pixel walks: mean {:.1f}, max {:.0f}", legend.mean, legend.max);
    case Overlay::cells:
      return fmt::format("{} with pixels; each has a colour and a number", cell_words(legend.cells));
    case Overlay::depth_range:
      return fmt::format("from the nearest to the farthest surface of a cell: mean {:.2f} m, max {:.1f} m", legend.mean,
                         legend.max);
    case Overlay::overflow:
      return fmt::format("{} pixels walk every light, because their cell did not fit", legend.cells);
    case Overlay::missed:
      return fmt::format("{} pixels miss a light that reaches them, {:.0f} pairs, says the oracle", legend.cells,
                         legend.max);
    case Overlay::difference:
      return fmt::format("{} pixels walk other numbers of lights: A {:+.1f} on average, {:.0f} at most", legend.cells,
                         legend.mean, legend.max);
    case Overlay::shadow_atlas:
      return fmt::format("{} lights have a shadow map; {:.0f} texels a side are shown, near is bright", legend.cells,
                         legend.max);
    case Overlay::shadow_age:
      return words_of_shadow_heat("frames since the oldest map that a pixel looks up was drawn", legend);
    case Overlay::shadow_size:
      return words_of_shadow_heat("texels a side of the smallest map that a pixel looks up", legend);
    case Overlay::shadow_leaks:
      return words_of_leaks(legend.leaks.value());
    case Overlay::slice:
      return fmt::format(
          "lights that points of the slice would walk: mean {:.1f}, max {:.0f}; {}; fainter behind surfaces",
          legend.mean, legend.max, cell_words(legend.cells));
    case Overlay::light_cells:
      return words_of_light_cells(legend, state.light.value_or(0));
    case Overlay::mask:
      return words_of_masks(legend, side.keeps_masks, side.stats.method);
    case Overlay::none:
      break;
  }
  return "";
}

/// What is the same for both sides is said once.
std::string words_of_legend(const Shown& shown) {
  std::string first = words_of_side(shown.first, shown.state);
  if (!shown.second) return first;
  const std::string second = words_of_side(*shown.second, shown.state);
  return first == second ? first : fmt::format("A: {}\nB: {}", first, second);
}

/// The scale is that of both.
const Legend& scaled_legend(const Shown& shown) {
  const bool second = shown.second && !shown.first.legend.refused.empty();
  return second ? shown.second->legend : shown.first.legend;
}

/// What colours stand for, side by side as far as there is room.
void draw_colors(float room, std::initializer_list<std::pair<glm::u8vec3, const char*>> colors) {
  const float side = ImGui::GetFontSize();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  float right = 0.0F;
  for (const auto& [color, words] : colors) {
    const float width = side + gap + ImGui::CalcTextSize(words).x;
    const bool beside = right > 0.0F && right + gap + width <= room;
    if (beside) ImGui::SameLine();
    right = beside ? right + gap + width : width;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, color_of(color));
    ImGui::Dummy({side, side});
    ImGui::SameLine();
    ImGui::TextUnformatted(words);
  }
}

}  // namespace

std::string why_no_overlay(Overlay overlay, const ViewState& state, const Shown& shown) {
  if (is_of_shadows(overlay) && !shown.first.stats.shadows) return "no light casts a shadow";
  if (overlay == Overlay::light_cells && !state.light) return NO_LIGHT;
  if (overlay == Overlay::difference && !state.against) return "needs a second method: see A against B, or press B";
  if (overlay == Overlay::slice && shown.number != 0 && !shown.first.any_depth)
    return fmt::format("{} lists lights for the depths of surfaces alone", shown.first.stats.method);
  return "";
}

void look_panel(PanelFrame& p) {
  if (!p.widgets.header("Picture and overlays", true)) return;
  bool automatic = p.state.exposure == "auto";
  if (p.widgets.check("automatic exposure", automatic, "As bright as the surfaces in sight ask for."))
    p.state.exposure = automatic ? "auto" : fmt::format("{}", p.shown.exposure);
  if (!automatic) {
    float factor = parse_exposure(p.state.exposure).value_or(1.0F);
    if (p.widgets.slide("exposure", factor, {.min = 0.001, .max = 1000.0, .logarithmic = true, .format = "%.3f"},
                        "The factor of the picture's brightness."))
      p.state.exposure = fmt::format("{}", factor);
  }
  p.widgets.choose_word(
      "overlay", p.state.overlay, overlay_names(),
      "What is laid over the picture: how many lights pixels walk, the cells, those that list one light, how deep they "
      "reach and what a mask of that leaves out, those that did not fit, what is missed, how two methods differ, how "
      "old and how large shadow maps are, where shadows leak or are false by rays, or a slice through the "
      "clusters.",
      [&](std::string_view name) {
        const auto overlay = static_cast<Overlay>(std::ranges::find(overlay_names(), name) - overlay_names().begin());
        return why_no_overlay(overlay, p.state, p.shown);
      });
  if (p.state.overlay == Overlay::slice)
    p.widgets.slide("slice distance", p.state.slice_m, {.min = 0.1, .max = 1000.0, .logarithmic = true},
                    "Metres ahead of the eye. The keys 3 and 4 move it.");
  p.widgets.check(
      "depth bins", p.state.depth_bins,
      "Bins of depth as a strip, for methods that have such: which of the lights, in the order of their depth, "
      "each bin has pixels walk.");
  p.widgets.choose_word("palette", p.state.palette, palette_names(),
                        "Colours of the scale. Blue-yellow and grey can be read with any colour vision.");
  bool dynamic = p.state.resolution == 0.0F;
  if (p.widgets.check("dynamic resolution", dynamic, "Smaller pictures where the device would draw too few of them."))
    p.state.resolution = dynamic ? 0.0F : 1.0F;
  if (!dynamic)
    p.widgets.slide("resolution", p.state.resolution, {.min = 0.1, .max = 1.0}, "Of what is drawn, over the screen's.");
}

void legend_window(const Shown& shown, const ScreenRect& picture, float lift, std::size_t numbers) {
  if (shown.first.legend.overlay == Overlay::none) return;
  ImGui::SetNextWindowPos({static_cast<float>(picture.min.x) + 8.0F, static_cast<float>(picture.max.y) - 8.0F - lift},
                          ImGuiCond_Always, {0.0F, 1.0F});
  constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("legend", nullptr, FIXED)) {
    const Legend& legend = scaled_legend(shown);
    const float room = std::max(100.0F, static_cast<float>(picture.size().x) - 32.0F);
    ImGui::PushTextWrapPos(room);
    ImGui::TextUnformatted(words_of_legend(shown).c_str());
    const std::uint64_t cells = shown.first.cells.cells + (shown.second ? shown.second->cells.cells : 0);
    if (const std::string words = words_of_numbers(cells, numbers); !words.empty())
      ImGui::TextUnformatted(words.c_str());
    ImGui::PopTextWrapPos();
    const Overlay overlay = legend.refused.empty() ? legend.overlay : Overlay::none;
    const bool scaled = overlay == Overlay::heat || overlay == Overlay::slice || in_metres(overlay) ||
                        overlay == Overlay::shadow_age || overlay == Overlay::shadow_size;
    if (scaled) draw_scale(legend, shown.state.palette, room);
    if (overlay == Overlay::difference)
      draw_colors(room, {{FIRST_WALKS_MORE, "A walks more"}, {SECOND_WALKS_MORE, "B walks more"}});
    if (overlay == Overlay::light_cells)
      draw_colors(room, {{REACHES_A_PIXEL, "it reaches a pixel of the cell"}, {LISTED_IN_VAIN, "listed in vain"}});
    if (overlay == Overlay::shadow_leaks) {
      const LeakColors colors = leak_colors(shown.state.palette);
      draw_colors(room, {{colors.leaked, "leaks"}, {colors.lost, "false shadow; full colour: all light of the pixel"}});
    }
    if (shown.picture_difference)
      ImGui::TextUnformatted(
          fmt::format("largest difference of the two pictures: {:.3g}", *shown.picture_difference).c_str());
  }
  ImGui::End();
}

}  // namespace lamp::app
