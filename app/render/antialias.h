// Several samples a pixel: a frame drawn again and again, its projection shifted by parts of a pixel, and averaged.
// Based on: Haeberli, Akeley, The Accumulation Buffer, SIGGRAPH (1990); offsets: Halton's sequence (1960).
// Promise: works with every method and path, because each frame is an ordinary one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "render/renderer.h"

namespace lamp::app {

/// Where in a pixel its i-th sample lies, pixels from the centre, within (-0.5, 0.5); the 0th is the centre.
[[nodiscard]] glm::dvec2 sample_offset(std::uint32_t i);

/// The view whose pixel centres lie `offset_px` beside those of `view`.
[[nodiscard]] View shifted(const View& view, glm::dvec2 offset_px);

/// Averages `first`, which was rendered at the pixels' centres, with `samples` - 1 more pictures of the same frame.
/// Leaves the renderer at the last of them.
[[nodiscard]] HdrImage average_samples(Renderer& renderer, Lighting& lighting, std::span<const shared::Light> lights,
                                       HdrImage first, std::uint32_t samples,
                                       std::span<const gpu::DecalData> decals = {});

}  // namespace lamp::app
