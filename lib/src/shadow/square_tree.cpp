// The quadtree of free squares.
// SPDX-License-Identifier: Apache-2.0
#include "square_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace lamp::shadow {
namespace {

constexpr std::uint32_t WORD_BITS = 64;

/// Every second bit of a Morton code.
std::uint32_t every_second(std::uint32_t code) {
  code &= 0x55555555U;
  code = (code | code >> 1U) & 0x33333333U;
  code = (code | code >> 2U) & 0x0f0f0f0fU;
  code = (code | code >> 4U) & 0x00ff00ffU;
  return (code | code >> 8U) & 0x0000ffffU;
}

}  // namespace

SquareTree::SquareTree(std::uint32_t root_level, std::uint32_t least_level)
    : root_level_(root_level), least_level_(least_level), levels_(root_level - least_level + 1) {
  for (std::uint32_t level = least_level; level <= root_level; ++level) {
    const std::size_t places = std::size_t{1} << (2 * (root_level - level));
    of(level).free.assign((places + WORD_BITS - 1) / WORD_BITS, 0);
    of(level).first = of(level).free.size();
  }
  set_free(root_level, 0);
}

bool SquareTree::is_free(std::uint32_t level, std::uint32_t place) {
  return (of(level).free[place / WORD_BITS] >> (place % WORD_BITS) & 1U) != 0;
}

void SquareTree::set_free(std::uint32_t level, std::uint32_t place) {
  Level& l = of(level);
  l.free[place / WORD_BITS] |= std::uint64_t{1} << (place % WORD_BITS);
  l.first = std::min<std::size_t>(l.first, place / WORD_BITS);
}

void SquareTree::set_taken(std::uint32_t level, std::uint32_t place) {
  of(level).free[place / WORD_BITS] &= ~(std::uint64_t{1} << (place % WORD_BITS));
}

std::optional<std::uint32_t> SquareTree::first_free(std::uint32_t level) {
  Level& l = of(level);
  while (l.first < l.free.size() && l.free[l.first] == 0) ++l.first;
  if (l.first == l.free.size()) return std::nullopt;
  return static_cast<std::uint32_t>(l.first * WORD_BITS) +
         static_cast<std::uint32_t>(std::countr_zero(l.free[l.first]));
}

std::optional<std::uint32_t> SquareTree::take(std::uint32_t level) {
  for (std::uint32_t from = level; from <= root_level_; ++from) {
    std::optional<std::uint32_t> place = first_free(from);
    if (!place) continue;
    set_taken(from, *place);
    // Of a larger square the first quarter is taken, and the three others are free.
    for (std::uint32_t at = from; at > level; --at) {
      *place *= 4;
      for (std::uint32_t quarter = 1; quarter < 4; ++quarter) set_free(at - 1, *place + quarter);
    }
    return place;
  }
  return std::nullopt;
}

void SquareTree::take_back(std::uint32_t level, std::uint32_t place) {
  std::uint32_t at = level;
  while (at < root_level_ && !is_free(at, place >> (2 * (at - level)))) ++at;
  assert(is_free(at, place >> (2 * (at - level))) && "take back only what is free");
  set_taken(at, place >> (2 * (at - level)));
  for (; at > level; --at) {
    const std::uint32_t kept = place >> (2 * (at - 1 - level));
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
      if ((kept & ~3U) + quarter != kept) set_free(at - 1, (kept & ~3U) + quarter);
  }
}

void SquareTree::give(std::uint32_t level, std::uint32_t place) {
  assert(!is_free(level, place) && "a square is given once");
  set_free(level, place);
  for (; level < root_level_; ++level) {
    const std::uint32_t first = place & ~3U;
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
      if (!is_free(level, first + quarter)) return;
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter) set_taken(level, first + quarter);
    place /= 4;
    set_free(level + 1, place);
  }
}

UVec2 SquareTree::position(std::uint32_t level, std::uint32_t place) {
  return {every_second(place) << level, every_second(place >> 1U) << level};
}

}  // namespace lamp::shadow
