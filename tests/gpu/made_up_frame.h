// Frames that no scene shows, of any size: blocks of surfaces with some sky between, and lights all among them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gpu/gpu_test.h"
#include "lamplight/view.h"

namespace lamp::app {

/// In perspective, reversed depth without a far plane; `turned` by radians about the vertical.
[[nodiscard]] View made_up_view(glm::uvec2 size, double turned = 0.0);

/// Surfaces 4 m to 7 m ahead of such a view; other blocks for another `shift`.
[[nodiscard]] float made_up_depth(glm::uvec2 pixel, std::uint32_t shift = 0);
[[nodiscard]] std::vector<float> made_up_depths(glm::uvec2 size, std::uint32_t shift = 0);

/// Small, in front of the surfaces, among them and behind them; three in ten are spots.
[[nodiscard]] std::vector<shared::Light> scattered_lights(const View& view, std::uint32_t count);

}  // namespace lamp::app
