// What the walk of a pixel's look-up was found to bring, against the oracle's truth.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "oracle/reference.h"

namespace lamp::app {

struct Visit {
  std::uint32_t visited = 0;         ///< lights walked
  std::uint32_t cell = 0;            ///< of the look-up, views one behind the other; SKY_CELL for sky
  std::uint32_t missed = 0;          ///< lights of the truth that the walk did not bring
  std::uint32_t first_missed = ~0U;  ///< the least of them
  std::uint32_t hash = 0;            ///< of the lights walked, in their order
  bool unordered = false;            ///< a light did not ascend
  bool ended = false;                ///< by the device before its end: what it did not bring is not known to be missed

  friend bool operator==(const Visit&, const Visit&) = default;
};

/// A truth without lights: for heat maps, where nothing is checked.
[[nodiscard]] Truth empty_truth(std::uint32_t width, std::uint32_t height);

}  // namespace lamp::app
