// Squares of powers of two in a larger one: a quadtree of what is free, in Morton order.
// Based on: Knowlton, A Fast Storage Allocator, CACM (1965), the buddy system, in two dimensions.
// Promise: squares never overlap; those of four neighbours that are free are one again; the lowest place is taken
// first.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lamplight/vectors.h"

namespace lamp::shadow {

/// Levels are powers of two: a square of level 4 is 16 texels wide. Places count squares of one level in Morton order.
class SquareTree {
 public:
  /// Of a root of `root_level`, down to squares of `least_level`.
  SquareTree(std::uint32_t root_level, std::uint32_t least_level);

  [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t level);
  /// This place, which was free all the time since it was given back.
  void take_back(std::uint32_t level, std::uint32_t place);
  void give(std::uint32_t level, std::uint32_t place);

  /// Top left of a place, texels.
  [[nodiscard]] static UVec2 position(std::uint32_t level, std::uint32_t place);

 private:
  /// Of one level: bit i says that place i is free and its parent is not.
  struct Level {
    std::vector<std::uint64_t> free;
    std::size_t first = 0;  ///< no word before this one has a bit
  };
  [[nodiscard]] Level& of(std::uint32_t level) { return levels_[level - least_level_]; }
  [[nodiscard]] bool is_free(std::uint32_t level, std::uint32_t place);
  void set_free(std::uint32_t level, std::uint32_t place);
  void set_taken(std::uint32_t level, std::uint32_t place);
  [[nodiscard]] std::optional<std::uint32_t> first_free(std::uint32_t level);

  std::uint32_t root_level_;
  std::uint32_t least_level_;
  std::vector<Level> levels_;
};

}  // namespace lamp::shadow
