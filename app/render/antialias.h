// Several samples a pixel: a frame drawn again and again, its projection shifted by parts of a pixel, and averaged.
// Based on: Haeberli, Akeley, The Accumulation Buffer, SIGGRAPH (1990); offsets: Halton's sequence (1960).
// Promise: works with every method and path, because each frame is an ordinary one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "render/renderer.h"

namespace lamp::app {

/// Where in a pixel its i-th sample lies, pixels from the centre, within (-0.5, 0.5); the 0th is the centre.
[[nodiscard]] glm::dvec2 sample_offset(std::uint32_t i);

/// The view whose pixel centres lie `offset_px` beside those of `view`.
[[nodiscard]] View shifted(const View& view, glm::dvec2 offset_px);

/// What is averaged and what is timed.
struct Sampling {
  std::uint32_t samples = 1;                              ///< of the picture, a pixel
  std::uint32_t frames = 1;                               ///< that are timed, at the pixels' centres
  std::uint32_t warm_up = 0;                              ///< frames before those, besides the other samples
  std::function<void(std::uint32_t)> progress = nullptr;  ///< called before each sample with its number
};

/// Renders the renderer's frame, the view that is shown: first the samples beside the pixels' centres, then the timed
/// frames at the centres, whose numbers these are. The picture is the average of all samples. `lights` and `decals` are
/// the frame's. Where the renderer's depth has several samples a pixel, it is those that are rendered, whatever
/// `sampling` says, the timed ones last. The first timed frame draws the shadow maps of the frame.
[[nodiscard]] Rendered render_samples(Renderer& renderer, Lighting& lighting, std::span<const shared::Light> lights,
                                      std::span<const gpu::DecalData> decals, const Sampling& sampling);

/// The same of all views of the renderer's frame, side by side in one picture, with the first view's numbers: its cull
/// is that of all. The first stays shown.
[[nodiscard]] Rendered render_views(Renderer& renderer, Lighting& lighting, std::span<const shared::Light> lights,
                                    std::span<const gpu::DecalData> decals, const Sampling& sampling);

}  // namespace lamp::app
