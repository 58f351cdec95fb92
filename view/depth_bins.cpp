// Words to columns, columns to rectangles.
// SPDX-License-Identifier: Apache-2.0
#include "view/depth_bins.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "render/heatmap_legend.h"

namespace lamp::app {
namespace {

constexpr float HEIGHT = 120.0F;  // pixels at scale 1
constexpr ImU32 PICKED = IM_COL32(255, 255, 255, 255);
constexpr ImU32 HOVERED = IM_COL32(255, 220, 60, 255);

/// The strip's place, and what is drawn in it.
struct Strip {
  const DepthBins& bins;
  std::size_t used = 1;
  ImVec2 min, max;

  [[nodiscard]] float x_of(std::size_t bin) const {
    return min.x + (max.x - min.x) * static_cast<float>(bin) / static_cast<float>(used);
  }
  [[nodiscard]] float y_of(std::uint32_t rank) const {
    return max.y - (max.y - min.y) * static_cast<float>(rank) / static_cast<float>(std::max(1U, bins.lights));
  }
};

/// Behind, grey, how long bins are over the longest; before that, which ranks they have.
void draw_columns(const Strip& strip, Palette palette, ImDrawList& draw) {
  const auto count = static_cast<std::size_t>(std::max(1.0F, strip.max.x - strip.min.x));
  const std::vector<BinColumn> columns = bin_columns(std::span(strip.bins.bins).first(strip.used), count);
  std::uint32_t longest = 1;
  for (const BinColumn& column : columns) longest = std::max(longest, column.longest);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].longest == 0) continue;
    const float left = strip.min.x + static_cast<float>(i);
    const float share = static_cast<float>(columns[i].longest) / static_cast<float>(longest);
    draw.AddRectFilled({left, strip.max.y - share * (strip.max.y - strip.min.y)}, {left + 1.0F, strip.max.y},
                       IM_COL32(90, 90, 90, 255));
    const glm::u8vec3 color =
        palette_color(palette, heat_position(columns[i].longest, std::max(2U, strip.bins.lights)));
    const float top = strip.y_of(columns[i].all.greatest + 1);
    draw.AddRectFilled({left, top}, {left + 1.0F, std::max(top + 1.0F, strip.y_of(columns[i].all.least))},
                       IM_COL32(color.r, color.g, color.b, 255));
  }
}

std::string words_of(const char* whose, const DepthBins& bins, std::uint32_t bin) {
  const BinRanks& ranks = bins.bins[bin];
  if (ranks.length() == 0) return fmt::format("{}: bin {}, no light", whose, bin);
  return fmt::format("{}: bin {}, lights {} to {} by depth, {} of {}", whose, bin, ranks.least, ranks.greatest,
                     ranks.length(), bins.lights);
}

void draw_bin(const Strip& strip, std::uint32_t bin, ImU32 color, ImDrawList& draw) {
  const float right = std::max(strip.x_of(bin) + 2.0F, strip.x_of(bin + 1));
  draw.AddRect({strip.x_of(bin) - 1.0F, strip.min.y}, {right, strip.max.y}, color);
}

std::optional<std::uint32_t> hovered_bin(const Shown& shown, const ScreenRect& picture) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::vec2 place = (glm::vec2(mouse.x, mouse.y) - glm::vec2(picture.min)) / glm::vec2(picture.size());
  const bool inside = place.x >= 0.0F && place.y >= 0.0F && place.x < 1.0F && place.y < 1.0F;
  if (!inside) return std::nullopt;
  return shown.bins->bin_at(glm::uvec2(place * glm::vec2(shown.view.width(), shown.view.height())));
}

void draw_strip(const Shown& shown, const ScreenRect& picture) {
  const DepthBins& bins = *shown.bins;
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float text = 3.0F * ImGui::GetTextLineHeightWithSpacing();
  Strip strip{.bins = bins,
              .used = used_bins(bins.bins),
              .min = min,
              .max = {min.x + room.x, min.y + std::max(8.0F, room.y - text)}};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_columns(strip, shown.state.palette, draw);
  ImGui::Dummy({room.x, strip.max.y - strip.min.y});
  const auto holding = std::ranges::count_if(bins.bins, [](const BinRanks& ranks) { return ranks.length() != 0; });
  ImGui::TextUnformatted(
      fmt::format("bins of depth, near to far, {} of {} with lights: which of all lights by depth; grey: how many",
                  holding, bins.bins.size())
          .c_str());
  const auto mark = [&](const char* whose, std::optional<std::uint32_t> bin, ImU32 color) {
    if (!bin) return;
    draw_bin(strip, *bin, color, draw);
    ImGui::TextUnformatted(words_of(whose, bins, *bin).c_str());
  };
  mark("under the mouse (yellow)", hovered_bin(shown, picture), HOVERED);
  if (shown.inspection) mark("the picked pixel (white)", bins.bin_at(shown.inspection->pixel), PICKED);
}

}  // namespace

std::optional<std::uint32_t> DepthBins::bin_at(glm::uvec2 pixel) const {
  const std::size_t number = pixel.x + std::size_t{width} * pixel.y;
  if (pixel.x >= width || number >= of_pixels.size() || of_pixels[number] >= bins.size()) return std::nullopt;
  return of_pixels[number];
}

std::vector<BinRanks> decode_bins(std::span<const std::uint32_t> words, bool wide) {
  std::vector<BinRanks> bins(wide ? words.size() / 2 : words.size());
  for (std::size_t i = 0; i < bins.size(); ++i)
    bins[i] = wide ? BinRanks{words[2 * i], words[2 * i + 1]} : BinRanks{words[i] & 0xFFFFU, words[i] >> 16U};
  return bins;
}

std::vector<BinColumn> bin_columns(std::span<const BinRanks> bins, std::size_t columns) {
  std::vector<BinColumn> made(columns);
  if (columns == 0) return made;
  for (std::size_t i = 0; i < columns; ++i) {  // a bin lies in all columns that it touches
    const std::size_t first = i * bins.size() / columns;
    const std::size_t end = std::max(first + 1, ((i + 1) * bins.size() + columns - 1) / columns);
    for (std::size_t bin = first; bin < std::min(end, bins.size()); ++bin) {
      if (bins[bin].length() == 0) continue;
      BinColumn& column = made[i];
      column.all = column.longest == 0 ? bins[bin]
                                       : BinRanks{std::min(column.all.least, bins[bin].least),
                                                  std::max(column.all.greatest, bins[bin].greatest)};
      column.longest = std::max(column.longest, bins[bin].length());
    }
  }
  return made;
}

std::size_t used_bins(std::span<const BinRanks> bins) {
  std::size_t used = bins.size();
  while (used > 1 && bins[used - 1].length() == 0) --used;
  return std::max<std::size_t>(used, 1);
}

float depth_bins_height(const Shown& shown, float scale) {
  if (!shown.state.depth_bins) return 0.0F;
  return shown.bins ? HEIGHT * scale : ImGui::GetTextLineHeightWithSpacing() + 2.0F * ImGui::GetStyle().WindowPadding.y;
}

void draw_depth_bins(const Shown& shown, const ScreenRect& picture, float scale) {
  if (!shown.state.depth_bins) return;
  const float height = depth_bins_height(shown, scale);
  ImGui::SetNextWindowPos({static_cast<float>(picture.min.x) + 8.0F, static_cast<float>(picture.max.y) - 8.0F - height},
                          ImGuiCond_Always);
  ImGui::SetNextWindowSize({std::max(80.0F, static_cast<float>(picture.size().x) - 16.0F), height});
  ImGui::SetNextWindowBgAlpha(0.85F);
  constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing |
                                     ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("depth bins", nullptr, FIXED)) {
    if (shown.bins)
      draw_strip(shown, picture);
    else
      ImGui::TextWrapped(
          "%s", fmt::format("{} has no bins of depth; drobot-zbin has", shown.inspected_side().stats.method).c_str());
  }
  ImGui::End();
}

}  // namespace lamp::app
