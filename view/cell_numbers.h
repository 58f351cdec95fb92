// Numbers of cells over the picture: where each can stand, and which are drawn. Pure but for the drawing.
// Promise: at most MOST_NUMBERS are drawn, and none covers another: each stands in its own cell.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "render/visit.h"
#include "view/gui.h"

namespace lamp::app {

struct Shown;

/// Where a cell's number can stand: a rectangle that the cell's visible pixels fill, around where they are widest. Of
/// several such places, near the middle of them all.
struct CellPlace {
  std::uint32_t cell = 0;
  glm::vec2 middle{0.0F};  ///< pixels of the picture
  glm::uvec2 room{0};      ///< of the rectangle, likewise

  friend bool operator==(const CellPlace&, const CellPlace&) = default;
};

struct CellPlaces {
  std::uint64_t cells = 0;        ///< that hold a pixel
  std::vector<CellPlace> places;  ///< of the MOST_NUMBERS with the most room
};
inline constexpr std::size_t MOST_NUMBERS = 4096;

/// Columns of a picture of this width.
struct Columns {
  std::uint32_t width = 0;
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};
/// Of the cells of those columns alone.
[[nodiscard]] CellPlaces cell_places(std::span<const Visit> visits, const Columns& columns);

/// Numbers in the cells that have room for them on the screen, where the state asks for cells. Says how many.
std::size_t draw_cell_numbers(const Shown& shown, const ScreenRect& picture);
/// Why some have none; empty if all have.
[[nodiscard]] std::string words_of_numbers(std::uint64_t cells, std::size_t drawn);

}  // namespace lamp::app
