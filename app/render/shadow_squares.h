// The squares of a light's shadow map in the atlas.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/shaders/shadow_data.h"

namespace lamp::app {

/// How many a map has; none without a map.
[[nodiscard]] inline std::uint32_t squares_of(const shared::ShadowMap& map) {
  if (map.kind == shared::SHADOW_NONE) return 0;
  return map.kind == shared::SHADOW_FACES ? shared::SQUARES_A_LIGHT : 1;
}

/// `square` of them.
[[nodiscard]] inline gpu::ShadowSquare square_at(const shared::ShadowMap& map, std::uint32_t square) {
  const std::uint32_t at = map.squares[square];
  return {.corner = {(at & 0xffffU) * shared::LEAST_SQUARE, (at >> 16U) * shared::LEAST_SQUARE}, .side = map.side};
}

}  // namespace lamp::app
