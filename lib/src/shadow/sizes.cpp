// Sizes of squares.
// SPDX-License-Identifier: Apache-2.0
#include "sizes.h"

#include <algorithm>
#include <cmath>

namespace lamp::shadow {
namespace {

// Of a level, beyond the half at which a size would round to the next: a light keeps its size while its share of the
// picture changes by less than 2^0.25, about a fifth.
constexpr float HYSTERESIS = 0.25F;

// All fall by a multiple of this: finer steps would move single lights more often, coarser ones waste more of the
// atlas.
constexpr float STEP = 0.25F;
constexpr int STEPS = 64;  // 16 levels: all are at the least one long before

// So much less would have to do before sizes rise again.
constexpr float RISE = 0.5F;

int rounded(float level, int most) {
  const auto top = static_cast<float>(std::max(most, LEAST_LEVEL));
  return static_cast<int>(std::round(std::fmin(std::fmax(level, LEAST_LEVEL), top)));  // also of infinities
}

std::uint64_t texels_at(std::span<const Wish> wishes, float fall) {
  std::uint64_t texels = 0;
  for (const Wish& wish : wishes) texels += texels_of(level_of(wish, fall), wish.squares);
  return texels;
}

std::uint64_t free_texels_at(std::span<const Wish> wishes, float fall) {
  std::uint64_t texels = 0;
  for (const Wish& wish : wishes) texels += texels_of(rounded(wish.level - fall, wish.most), wish.squares);
  return texels;
}

/// The least multiple of STEP from `from` on at which they fit; the largest if none does. They fit the better the more
/// they fall.
template <class Texels>
float least_fall(std::span<const Wish> wishes, std::uint64_t room, float from, Texels texels) {
  int low = static_cast<int>(from / STEP);
  int high = STEPS;
  while (low < high) {
    const int middle = (low + high) / 2;
    if (texels(wishes, static_cast<float>(middle) * STEP) <= room)
      high = middle;
    else
      low = middle + 1;
  }
  return static_cast<float>(low) * STEP;
}

}  // namespace

int level_of(const Wish& wish, float fall) {
  const float level = wish.level - fall;
  const bool keeps = wish.current != NO_LEVEL && wish.current <= wish.most &&
                     std::abs(level - static_cast<float>(wish.current)) <= 0.5F + HYSTERESIS;
  return keeps ? wish.current : rounded(level, wish.most);
}

float choose_fall(std::span<const Wish> wishes, std::uint64_t texels, float last) {
  const float least = least_fall(wishes, texels, 0.0F, free_texels_at);
  if (last >= least && last - least < RISE && texels_at(wishes, last) <= texels) return last;
  return least_fall(wishes, texels, least, texels_at);
}

}  // namespace lamp::shadow
