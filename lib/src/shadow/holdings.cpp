// Takes and gives squares.
// SPDX-License-Identifier: Apache-2.0
#include "holdings.h"

#include <utility>

namespace lamp::shadow {

std::vector<UVec2> Holdings::corners(const Holding& holding) {
  std::vector<UVec2> corners;
  for (std::uint32_t i = 0; i < holding.squares; ++i)
    corners.push_back(SquareTree::position(static_cast<std::uint32_t>(holding.level), holding.places[i]));
  return corners;
}

void Holdings::give(Holding& holding) {
  const auto level = static_cast<std::uint32_t>(holding.level);
  for (std::uint32_t i = 0; i < holding.squares; ++i) tree_.give(level, holding.places[i]);
  used_texels_ -= texels_of(holding.level, holding.squares);
  holding.level = NO_LEVEL;
}

bool Holdings::take(Holding& holding, std::uint32_t squares, int level) {
  for (std::uint32_t i = 0; i < squares; ++i) {
    const auto place = tree_.take(static_cast<std::uint32_t>(level));
    if (!place) {
      while (i > 0) tree_.give(static_cast<std::uint32_t>(level), holding.places[--i]);
      return false;
    }
    holding.places[i] = *place;
  }
  holding.level = level;
  holding.squares = squares;
  used_texels_ += texels_of(level, squares);
  return true;
}

void Holdings::release(Holding& holding) {
  if (holding.level != NO_LEVEL) give(holding);
  holding.drawn = false;
  holding.map = {};
}

bool Holdings::evict_one(std::uint64_t frame) {
  Holding* longest = nullptr;
  for (Holding& holding : all_)
    if (holding.level != NO_LEVEL && holding.last_seen < frame &&
        (longest == nullptr || holding.last_seen < longest->last_seen))
      longest = &holding;
  if (longest == nullptr) return false;
  release(*longest);
  ++evicted_;
  return true;
}

bool Holdings::resize(Holding& holding, std::uint32_t squares, int level, std::uint64_t frame) {
  const Holding before = holding;
  if (before.level != NO_LEVEL) give(holding);
  const bool keeps = before.level != NO_LEVEL && before.squares == squares;
  const int least = keeps && before.level < level ? before.level + 1 : LEAST_LEVEL;
  for (int at = level; at >= least; --at) {
    do {
      if (take(holding, squares, at)) return true;
    } while (evict_one(frame));
  }
  if (!keeps) return false;
  for (std::uint32_t i = 0; i < squares; ++i)
    tree_.take_back(static_cast<std::uint32_t>(before.level), before.places[i]);
  used_texels_ += texels_of(before.level, squares);
  holding.level = before.level;
  holding.places = before.places;
  return true;
}

std::uint32_t Holdings::take_evicted() { return std::exchange(evicted_, 0); }

}  // namespace lamp::shadow
