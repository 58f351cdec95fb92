// A captured frame to the texels of the G-buffer and back, on the host.
// Promise: texels that are decoded and encoded again show the same picture, bit for bit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/captured_frame.h"

namespace lamp::app {

/// Row by row from the top, in the formats of Targets.
struct GBufferTexels {
  std::vector<float> depth;
  std::vector<glm::u8vec4> base_color;  ///< sRGB
  std::vector<glm::uvec2> surface;      ///< as shaders/common/gbuffer.glsl packs it
  std::vector<glm::u16vec4> emission;   ///< half floats
};

/// Rounds to the nearest texel.
[[nodiscard]] GBufferTexels encode(const CapturedFrame& frame);
[[nodiscard]] CapturedFrame decode(const View& view, const GBufferTexels& texels);

}  // namespace lamp::app
