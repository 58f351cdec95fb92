// Depth and views as hosts have them, which the renderer can be asked to draw.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "lamplight/view.h"

namespace lamp::app {

struct HostDepth {
  std::uint32_t samples = 1;  ///< a pixel: 1, 2, 4 or 8
  bool reversed = true;       ///< near 1 and sky 0; else near 0 and sky 1
  std::uint32_t views = 1;    ///< of a frame, each with its own depth, 1 .. MAX_VIEWS

  /// Pictures that lights are culled for at once are more than the one that is drawn.
  [[nodiscard]] bool several() const { return samples > 1 || views > 1; }

  [[nodiscard]] float sky() const { return reversed ? 0.0F : 1.0F; }
  /// How a depth compares with that of something farther.
  [[nodiscard]] VkCompareOp nearer() const { return reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS; }
  [[nodiscard]] VkCompareOp not_nearer() const {
    return reversed ? VK_COMPARE_OP_LESS_OR_EQUAL : VK_COMPARE_OP_GREATER_OR_EQUAL;
  }
};

/// Which of a frame's pictures is drawn: of one of its views, through one sample of its depth.
struct FramePicture {
  std::uint32_t view = 0;
  std::uint32_t sample = 0;
};

/// The same view with depth the other way round: near 0, sky 1. Of a view with reversed depth.
[[nodiscard]] View with_standard_depth(const View& view);

}  // namespace lamp::app
