// Parts that hold a surface are counted; parts are drawn.
// SPDX-License-Identifier: Apache-2.0
#include "view/mask_overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "render/shaders/sky_cell.h"
#include "view/inspection.h"
#include "view/overlay_colors.h"
#include "view/widgets.h"

namespace lamp::app {
namespace {

constexpr ImU32 EMPTY_PART = IM_COL32(70, 70, 70, 255);
constexpr ImU32 SURFACE_PART = IM_COL32(235, 235, 235, 255);
constexpr ImU32 LIGHT_PART = IM_COL32(255, 200, 40, 255);

/// One row of parts, near to far.
void draw_parts(std::uint32_t set, ImU32 color, ImU32 otherwise, float height) {
  const float step = ImGui::GetContentRegionAvail().x / static_cast<float>(gpu::MASK_PARTS);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::uint32_t part = 0; part < gpu::MASK_PARTS; ++part) {
    const float left = at.x + step * static_cast<float>(part);
    draw.AddRectFilled({left, at.y}, {left + step - 1.0F, at.y + height}, (set >> part & 1U) != 0 ? color : otherwise);
  }
  ImGui::Dummy({step * static_cast<float>(gpu::MASK_PARTS), height});
}

}  // namespace

NumberedCells numbered_cells(std::span<const Visit> visits) {
  NumberedCells made;
  made.of_pixels.reserve(visits.size());
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (const Visit& visit : visits) {
    if (visit.cell == gpu::SKY_CELL)
      made.of_pixels.push_back(gpu::NO_CELL);
    else
      made.of_pixels.push_back(
          numbers.try_emplace(visit.cell, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  made.count = static_cast<std::uint32_t>(numbers.size());
  return made;
}

double empty_m(const gpu::CellMask& cell) {
  const double empty = gpu::MASK_PARTS - static_cast<std::uint32_t>(std::popcount(cell.mask));
  return (double{cell.z_far} - double{cell.z_near}) * empty / gpu::MASK_PARTS;
}

Overlaid make_mask_overlay(Palette palette, std::span<const std::uint32_t> of_pixels,
                           std::span<const gpu::CellMask> masks, double scale_least) {
  Overlaid made{.pixels = std::vector<std::uint32_t>(of_pixels.size(), sky_dimmed()),
                .legend = {.overlay = Overlay::mask, .cells = masks.size()}};
  Legend& legend = made.legend;
  for (const gpu::CellMask& cell : masks) {
    legend.max = std::max(legend.max, empty_m(cell));
    legend.mean += empty_m(cell) / static_cast<double>(masks.size());
    legend.low += std::popcount(cell.mask) / static_cast<double>(masks.size());
  }
  legend.high = std::max({scale_least, legend.max, 1e-3});
  for (std::size_t i = 0; i < of_pixels.size(); ++i)
    if (of_pixels[i] != gpu::NO_CELL)
      made.pixels[i] = rgba(palette_color(palette, empty_m(masks[of_pixels[i]]) / legend.high), MAP_ALPHA);
  return made;
}

std::string words_of_masks(const Legend& legend, bool keeps_masks, const std::string& method) {
  return fmt::format(
      "metres of a cell's depths in parts without a surface: mean {:.2f}, max {:.1f}; {:.1f} of {} parts "
      "hold one\n{}",
      legend.mean, legend.max, legend.low, gpu::MASK_PARTS,
      keeps_masks ? fmt::format("{} drops lights that lie in empty parts alone", method)
                  : fmt::format("{}, as it is set, keeps no mask: this is what one would say", method));
}

std::string words_of_parts(const Inspection& found) {
  if (!found.looked_at) return "";
  const LookedAt& light = *found.looked_at;
  const int meets = std::popcount(light.parts & found.mask.mask);
  std::string words = fmt::format("light {}, yellow: beside {} parts, {} of them with a surface", light.light,
                                  std::popcount(light.parts), meets);
  if (light.parts == 0) words = fmt::format("light {}: before or behind all these depths", light.light);
  if (light.listed) return words;
  const std::uint32_t dropping = gpu::PASSES_ALL & ~light.passes;
  return words + (dropping == 0 ? "; it is not in this list"
                                : fmt::format("; not in this list: dropped by {}", names_of(dropping)));
}

void mask_of_cell(const Inspection& found) {
  const float height = ImGui::GetFontSize();
  draw_parts(found.mask.mask, SURFACE_PART, EMPTY_PART, height);
  if (found.looked_at) draw_parts(found.looked_at->parts, LIGHT_PART, IM_COL32(0, 0, 0, 0), 0.4F * height);
  Widgets::note(fmt::format("mask, {:.2f} to {:.2f} m: {} of {} parts hold a surface (white), {:.2f} m are empty",
                            found.mask.z_near, found.mask.z_far, std::popcount(found.mask.mask), gpu::MASK_PARTS,
                            empty_m(found.mask)));
  if (const std::string words = words_of_parts(found); !words.empty()) Widgets::note(words);
}

}  // namespace lamp::app
