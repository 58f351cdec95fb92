// Where in the picture shadow maps are old, small, late or missing: a number a pixel, for heat maps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/shadow_heat_data.h"

namespace lamp::app {

enum class ShadowHeat : std::uint8_t {
  age,   ///< frames since the oldest map was drawn
  size,  ///< texels a side of the smallest map
};

/// Of each pixel that is shown, row by row, over the maps of the lights that reach it: 0 where there is none, or the
/// oldest is of this frame; gpu::WITHOUT_SHADOW, gpu::WAITS_FOR_REDRAWING, gpu::SKY_CELL. The renderer's lights cast
/// shadows, and a frame was drawn.
[[nodiscard]] std::vector<std::uint32_t> shadow_heat(Renderer& renderer, Lighting& lighting, ShadowHeat of);

}  // namespace lamp::app
