// What a mask of occupied depths leaves out of each cell, and the mask of one cell as a strip. Pure but for the
// drawing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/shaders/cell_mask_data.h"
#include "view/overlay.h"

namespace lamp::app {

struct Inspection;

/// The cells that hold pixels by small numbers, as gpu::CellMask has them.
struct NumberedCells {
  std::vector<std::uint32_t> of_pixels;  ///< gpu::NO_CELL: sky
  std::uint32_t count = 0;
};
[[nodiscard]] NumberedCells numbered_cells(std::span<const Visit> visits);

/// Metres of a cell's depths, from its nearest to its farthest surface, in parts without a surface.
[[nodiscard]] double empty_m(const gpu::CellMask& cell);

/// Metres that each pixel's cell has empty: bright where a mask wins. The legend's `mean` and `max` are of the cells,
/// `low` is how many parts of 32 hold a surface, on average.
[[nodiscard]] Overlaid make_mask_overlay(Palette palette, std::span<const std::uint32_t> of_pixels,
                                         std::span<const gpu::CellMask> masks, double scale_least);
/// `keeps_masks`: the method does, and `method` names it.
[[nodiscard]] std::string words_of_masks(const Legend& legend, bool keeps_masks, const std::string& method);

/// A part of the inspector: the parts of the cell's depths, near to far; those that hold a surface, and those that the
/// light that is looked at lies beside.
void mask_of_cell(const Inspection& found);
/// How the mask and the light's depths meet, or which tests drop the light; empty where none is looked at.
[[nodiscard]] std::string words_of_parts(const Inspection& found);

}  // namespace lamp::app
