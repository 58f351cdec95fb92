// Two passes over the pixels: what is known of each cell, then its tone.
// SPDX-License-Identifier: Apache-2.0
#include "view/light_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "commands/stats.h"
#include "render/shaders/sky_cell.h"
#include "view/overlay_colors.h"

namespace lamp::app {
namespace {

constexpr float CELL_ALPHA = 0.4F;
constexpr float EDGE_ALPHA = 0.65F;

struct LightInCell {
  bool listed = false;
  bool reached = false;
};

using LightInCells = std::unordered_map<std::uint32_t, LightInCell>;

LightInCells known_cells(const LightSeen& seen) {
  LightInCells cells;
  for (std::size_t i = 0; i < seen.visits.size(); ++i) {
    if (seen.visits[i].cell == gpu::SKY_CELL) continue;
    LightInCell& cell = cells[seen.visits[i].cell];
    cell.listed = cell.listed || seen.listed[i] != 0;
    cell.reached = cell.reached || seen.reached[i] == Reach::inside;
  }
  return cells;
}

/// The last of a cell's pixels to the right or downwards.
bool is_edge(const LightSeen& seen, std::size_t pixel) {
  const auto other = [&](std::size_t neighbour) {
    return neighbour < seen.visits.size() && seen.visits[neighbour].cell != seen.visits[pixel].cell;
  };
  return ((pixel + 1) % seen.width != 0 && other(pixel + 1)) || other(pixel + seen.width);
}

std::uint32_t tone(const LightSeen& seen, std::size_t pixel, const LightInCell& cell) {
  const bool reached = seen.reached[pixel] == Reach::inside;
  if (!cell.listed) return reached ? rgba(SIGNAL, SIGNAL_ALPHA) : dimmed();
  const glm::u8vec3 color = cell.reached ? REACHES_A_PIXEL : LISTED_IN_VAIN;
  if (is_edge(seen, pixel)) return rgba(color / glm::u8vec3(3), EDGE_ALPHA);
  return rgba(color, reached ? SIGNAL_ALPHA : CELL_ALPHA);
}

}  // namespace

Overlaid make_light_cells(const LightSeen& seen) {
  const LightInCells cells = known_cells(seen);
  Overlaid made{.pixels = std::vector<std::uint32_t>(seen.visits.size(), sky_dimmed()),
                .legend = {.overlay = Overlay::light_cells}};
  for (const auto& [cell, known] : cells) {
    made.legend.cells += known.listed ? 1 : 0;
    made.legend.reached += known.listed && known.reached ? 1 : 0;
    made.legend.lacking += !known.listed && known.reached ? 1 : 0;
  }
  for (std::size_t i = 0; i < made.pixels.size(); ++i)
    if (seen.visits[i].cell != gpu::SKY_CELL) made.pixels[i] = tone(seen, i, cells.at(seen.visits[i].cell));
  return made;
}

std::string words_of_light_cells(const Legend& legend, std::uint32_t light) {
  std::string words = fmt::format("light {}: listed in no cell of the picture", light);
  if (legend.cells != 0)
    words =
        fmt::format("light {}: listed in {}, reaches a pixel in {} of them: {:.0f} %", light, cell_words(legend.cells),
                    legend.reached, 100.0 * static_cast<double>(legend.reached) / static_cast<double>(legend.cells));
  if (legend.lacking != 0)
    words += fmt::format("; missing in {} in which it reaches a pixel", cell_words(legend.lacking));
  return words;
}

void cells_of_light(ViewState& state, Widgets& widgets) {
  if (!state.light) return;
  bool shown = state.overlay == Overlay::light_cells;
  if (widgets.check("its cells in the picture", shown,
                    "The cells that list the light: blue where it reaches a pixel, orange where it is listed in vain. "
                    "K does the same."))
    state.overlay = shown ? Overlay::light_cells : Overlay::none;
}

}  // namespace lamp::app
