// Masks of cells: of any pixels' depths, what a cull with a mask of occupied depths keeps of them.
// Promise: by that cull's own shader functions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/cell_mask_data.h"

namespace lamp::app {

/// Of the last frame. `cell_of`: of each pixel, row by row, a cell below `count`, or gpu::NO_CELL. Each cell has a
/// pixel that shows a surface, and all that it has do.
[[nodiscard]] std::vector<gpu::CellMask> cell_masks(Renderer& renderer, std::span<const std::uint32_t> cell_of,
                                                    std::uint32_t count);

}  // namespace lamp::app
