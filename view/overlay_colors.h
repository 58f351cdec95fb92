// What overlays share: colours as the display takes them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace lamp::app {

inline constexpr float MAP_ALPHA = 0.6F;
inline constexpr float SIGNAL_ALPHA = 0.8F;
inline constexpr glm::u8vec3 SIGNAL{255, 0, 200};

/// Eight bits each, red lowest.
[[nodiscard]] inline std::uint32_t rgba(glm::u8vec3 color, float alpha) {
  const auto a = static_cast<std::uint32_t>(std::lround(255.0F * alpha));
  return color.r | static_cast<std::uint32_t>(color.g) << 8U | static_cast<std::uint32_t>(color.b) << 16U | a << 24U;
}

/// Of pixels without a cell, and of those that an overlay is not about.
[[nodiscard]] inline std::uint32_t sky_dimmed() { return rgba({0, 0, 0}, 0.7F); }  // as heat maps over pictures have it
[[nodiscard]] inline std::uint32_t dimmed() { return rgba({0, 0, 0}, 0.3F); }

}  // namespace lamp::app
