// Walks look-ups where there is no surface: at one depth ahead of the eye, through every pixel.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/renderer.h"

namespace lamp::app {

/// What a point of each pixel's ray would walk, `z_view` metres ahead, in a frame that was drawn. Of methods that are
/// right for any depth; of others, what shading would walk if a surface were there.
[[nodiscard]] std::vector<Visit> visit_at(Renderer& renderer, Lighting& lighting, float z_view);

}  // namespace lamp::app
