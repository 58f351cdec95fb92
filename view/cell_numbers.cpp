// Distances to other cells, in two passes over the pixels; a rectangle grown from each cell's farthest pixel.
// Based on: Rosenfeld, Pfaltz, Distance functions on digital pictures, Pattern Recognition 1 (1968), for the two
// passes.
// SPDX-License-Identifier: Apache-2.0
#include "view/cell_numbers.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <unordered_map>

#include "render/shaders/sky_cell.h"
#include "view/shown.h"

namespace lamp::app {
namespace {

constexpr float MARGIN_PX = 2.0F;  // of the screen, around a number

/// The cells of some columns, row by row.
class CellMap {
 public:
  CellMap(std::span<const Visit> visits, const Columns& columns)
      : visits_(visits), columns_(columns), height_(static_cast<int>(visits.size() / columns.width)) {}

  [[nodiscard]] int width() const { return static_cast<int>(columns_.end - columns_.first); }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::uint32_t at(int x, int y) const {
    return visits_[columns_.first + static_cast<std::size_t>(x) +
                   std::size_t{columns_.width} * static_cast<std::size_t>(y)]
        .cell;
  }
  [[nodiscard]] bool is(std::uint32_t cell, int x, int y) const {
    return x >= 0 && y >= 0 && x < width() && y < height_ && at(x, y) == cell;
  }

 private:
  std::span<const Visit> visits_;
  Columns columns_;
  int height_;
};

/// How many steps, each to one of eight neighbours, lead out of the cell; at least 1.
std::vector<int> steps_out(const CellMap& map) {
  const int width = map.width();
  std::vector<int> steps(static_cast<std::size_t>(width) * static_cast<std::size_t>(map.height()));
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(x) + static_cast<std::size_t>(width) * static_cast<std::size_t>(y);
  };
  // The neighbours that a pass has been to, of a pass that goes forwards; backwards, they are mirrored.
  constexpr glm::ivec2 BEFORE[] = {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (const int way : {1, -1})
    for (int row = 0; row < map.height(); ++row)
      for (int column = 0; column < width; ++column) {
        const int x = way == 1 ? column : width - 1 - column;
        const int y = way == 1 ? row : map.height() - 1 - row;
        int least = way == 1 ? width + map.height() : steps[index(x, y)];
        for (const glm::ivec2& before : BEFORE) {
          const glm::ivec2 to = glm::ivec2(x, y) + way * before;
          least = std::min(least, map.is(map.at(x, y), to.x, to.y) ? steps[index(to.x, to.y)] + 1 : 1);
        }
        steps[index(x, y)] = least;
      }
  return steps;
}

/// What is known of a cell while the pixels are passed.
struct Found {
  glm::dvec2 sum{0.0};
  double pixels = 0.0;
  glm::ivec2 widest{0};
  int steps = 0;
  double from_middle = 0.0;  ///< squared
};

class CellTable {
 public:
  /// Neighbours mostly ask for the same.
  Found& operator[](std::uint32_t cell) {
    if (last_ == nullptr || cell != last_cell_) {
      last_ = &found_[cell];
      last_cell_ = cell;
    }
    return *last_;
  }
  [[nodiscard]] const std::unordered_map<std::uint32_t, Found>& all() const { return found_; }

 private:
  std::unordered_map<std::uint32_t, Found> found_;
  Found* last_ = nullptr;
  std::uint32_t last_cell_ = 0;
};

template <class Use>
void for_cell_pixels(const CellMap& map, const Use& use) {
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (map.at(x, y) != gpu::SKY_CELL) use(map.at(x, y), glm::ivec2(x, y));
}

CellTable found_cells(const CellMap& map) {
  CellTable cells;
  for_cell_pixels(map, [&](std::uint32_t cell, glm::ivec2 at) {
    cells[cell].sum += glm::dvec2(at);
    cells[cell].pixels += 1.0;
  });
  const std::vector<int> steps = steps_out(map);
  for_cell_pixels(map, [&](std::uint32_t cell, glm::ivec2 at) {
    Found& found = cells[cell];
    const glm::dvec2 offset = glm::dvec2(at) - found.sum / found.pixels;
    const double from_middle = glm::dot(offset, offset);
    const int out =
        steps[static_cast<std::size_t>(at.x) + static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(at.y)];
    if (out < found.steps || (out == found.steps && from_middle >= found.from_middle)) return;
    found.widest = at;
    found.steps = out;
    found.from_middle = from_middle;
  });
  return cells;
}

/// From a square that fits, to the sides first: a number is wider than high.
CellPlace grown(const CellMap& map, std::uint32_t cell, const Found& found) {
  glm::ivec2 min = found.widest - (found.steps - 1);
  glm::ivec2 end = found.widest + found.steps;
  const auto column = [&](int x) {
    for (int y = min.y; y < end.y; ++y)
      if (!map.is(cell, x, y)) return false;
    return true;
  };
  const auto row = [&](int y) {
    for (int x = min.x; x < end.x; ++x)
      if (!map.is(cell, x, y)) return false;
    return true;
  };
  while (column(min.x - 1)) --min.x;
  while (column(end.x)) ++end.x;
  while (row(min.y - 1)) --min.y;
  while (row(end.y)) ++end.y;
  return {.cell = cell, .middle = 0.5F * glm::vec2(min + end), .room = glm::uvec2(end - min)};
}

void draw_number(ImDrawList& draw, const std::string& words, const ImVec2& size, glm::vec2 middle) {
  const ImVec2 at(std::round(middle.x - 0.5F * size.x), std::round(middle.y - 0.5F * size.y));
  draw.AddRectFilled({at.x - MARGIN_PX, at.y}, {at.x + size.x + MARGIN_PX, at.y + size.y}, IM_COL32(0, 0, 0, 170),
                     MARGIN_PX);
  draw.AddText(at, IM_COL32_WHITE, words.c_str());
}

}  // namespace

CellPlaces cell_places(std::span<const Visit> visits, const Columns& columns) {
  if (columns.first >= columns.end || visits.empty()) return {};
  const CellMap map(visits, columns);
  const CellTable cells = found_cells(map);
  CellPlaces made{.cells = cells.all().size(), .places = {}};
  made.places.reserve(cells.all().size());
  for (const auto& [cell, found] : cells.all()) {
    CellPlace& place = made.places.emplace_back(grown(map, cell, found));
    place.middle.x += static_cast<float>(columns.first);
  }
  const auto before = [](const CellPlace& a, const CellPlace& b) {
    const auto room = [](const CellPlace& place) { return std::min(place.room.x, 3 * place.room.y); };
    return room(a) != room(b) ? room(a) > room(b) : a.cell < b.cell;
  };
  std::ranges::sort(made.places, before);
  if (made.places.size() > MOST_NUMBERS) made.places.resize(MOST_NUMBERS);
  return made;
}

std::size_t draw_cell_numbers(const Shown& shown, const ScreenRect& picture) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const glm::vec2 scale = glm::vec2(picture.size()) / glm::vec2(shown.view.width(), shown.view.height());
  std::size_t drawn = 0;
  const auto draw_side = [&](const ShownSide& side) {
    for (const CellPlace& place : side.cells.places) {
      const std::string words = fmt::format("{}", place.cell);
      const ImVec2 size = ImGui::CalcTextSize(words.c_str());
      const glm::vec2 room = glm::vec2(place.room) * scale;
      if (size.x + 4.0F * MARGIN_PX > room.x || size.y > room.y) continue;
      draw_number(draw, words, size, glm::vec2(picture.min) + place.middle * scale);
      ++drawn;
    }
  };
  draw_side(shown.first);
  if (shown.second) draw_side(*shown.second);
  return drawn;
}

std::string words_of_numbers(std::uint64_t cells, std::size_t drawn) {
  if (drawn >= cells) return "";
  if (drawn >= MOST_NUMBERS) return fmt::format("the numbers of the {} largest are shown", drawn);
  return drawn == 0 ? "they are too small for their numbers" : "cells that are too small for their number have none";
}

}  // namespace lamp::app
