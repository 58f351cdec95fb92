// Which size each light's squares get, as a power of two, so that all fit.
// Promise: sizes that fit stay while the picture asks for about the same; where not all fit, all fall together.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace lamp::shadow {

inline constexpr int LEAST_LEVEL = 4;  // 16 texels
inline constexpr int MOST_LEVEL = 11;  // 2048 texels
inline constexpr int NO_LEVEL = -1;

struct Wish {
  float level = 0.0F;      ///< log2 of the side that the light's share of the picture asks for
  int current = NO_LEVEL;  ///< that it has
  int most = MOST_LEVEL;   ///< >= LEAST_LEVEL
  std::uint32_t squares = 1;
};

/// The level of a light when all wishes are lower by `fall`.
[[nodiscard]] int level_of(const Wish& wish, float fall);

/// By how much all wishes fall so that the squares take at most `texels`, or have the least size; `last` if that
/// serves.
[[nodiscard]] float choose_fall(std::span<const Wish> wishes, std::uint64_t texels, float last);

[[nodiscard]] constexpr std::uint64_t texels_of(int level, std::uint64_t squares) { return squares << (2 * level); }

}  // namespace lamp::shadow
