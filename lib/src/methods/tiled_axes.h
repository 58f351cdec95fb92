// The axes of tiled culling: what `--option` can set, and how a plan reads it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <utility>

#include "lamplight/method.h"
#include "lamplight/shared/tile.h"

namespace lamp {

// Defaults of the options that size lists, and the largest that a list in shared memory may be.
inline constexpr std::uint32_t TILE_CAPACITY = 512;
inline constexpr std::uint32_t TILE_MEAN_CAPACITY = 128;
inline constexpr std::uint32_t MOST_TILE_CAPACITY = 2048;

/// The options of a tiled method, parsed.
struct TiledAxes {
  std::uint32_t tile_px = 16;
  std::uint32_t capacity = TILE_CAPACITY;            ///< lights a list has room for
  std::uint32_t mean_capacity = TILE_MEAN_CAPACITY;  ///< lights a cell, on average, that a shared list has room for
  std::uint32_t bounds = shared::BOUNDS_MINMAX;
  std::uint32_t test = shared::TEST_PLANES;
  std::uint32_t spot = shared::SPOT_SPHERE;
  std::uint32_t order = shared::ORDER_INDEX;
  enum class Reduce : std::uint8_t { atomic, subgroup, parallel } reduce = Reduce::atomic;
  bool bits = false;           ///< container
  bool prune = false;          ///< by pixel
  bool aos = false;            ///< bounds made from the light records
  bool radial = false;         ///< lights cut by their radial bounds
  bool shapes = false;         ///< boxes by their shape
  bool cached_frusta = false;  ///< kept until size or projection changes

  [[nodiscard]] std::uint32_t ranges() const {
    return bounds == shared::BOUNDS_HALF || bounds == shared::BOUNDS_MODIFIED_HALF ? 2 : 1;
  }
  /// The light records, and not only the bounds.
  [[nodiscard]] bool reads_lights() const {
    return aos || prune || shapes || spot != shared::SPOT_SPHERE || order == shared::ORDER_TYPE;
  }
  [[nodiscard]] bool cone() const { return test == shared::TEST_CONE || test == shared::TEST_CONE_APPROXIMATE; }
};

[[nodiscard]] TiledAxes tiled_axes(const Options& options);

/// The options of every tiled method, with other fallbacks where a preset names them.
[[nodiscard]] std::vector<OptionSpec> tiled_options(
    std::initializer_list<std::pair<std::string_view, std::string_view>> fallbacks = {});

/// Why a combination is impossible, or nothing.
[[nodiscard]] std::optional<Error> check_tiled(const Problem& problem);

/// The one plan of all tiled methods.
[[nodiscard]] Plan plan_tiled(const Problem& problem);

}  // namespace lamp
