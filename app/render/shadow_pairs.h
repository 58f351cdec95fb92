// What the look-up of shadows says of pairs of pixel and light.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/shadow_pair_data.h"

namespace lamp::app {

/// texels: also what those around say, which takes hundreds of them a pair. Else answers have it that they differ.
enum class ShadowAsked : std::uint8_t { share, texels };

/// Of the renderer's frame, which casts shadows and whose surfaces are drawn; an answer for each pair.
[[nodiscard]] std::vector<gpu::ShadowAnswer> ask_shadows(Renderer& renderer, const ShaderLibrary& shaders,
                                                         std::span<const gpu::ShadowPair> pairs, ShadowAsked asked);

}  // namespace lamp::app
