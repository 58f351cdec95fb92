// The legend of a heat map: title, mean, maximum, and the colours of the logarithmic scale with their numbers.
// Promise: it is appended below the picture and hides no pixel of the map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "render/legend_strip.h"

namespace lamp::app {

struct HeatSummary {
  double mean = 0.0;                                         ///< lights per pixel, over the pixels that have a cell
  std::uint32_t max = 0;                                     ///< lights
  std::uint32_t top = 2;                                     ///< lights at the top of the scale
  std::string unit;                                          ///< of the counts
  std::vector<std::pair<glm::u8vec3, std::string>> signals;  ///< colours beside the scale, and what they mean
};

/// Where a count >= 1 stands on the scale 1 .. scale_max: 0 .. 1, by its logarithm. Larger counts stand at 1.
[[nodiscard]] double heat_position(double count, std::uint32_t scale_max);

/// The colour of a position 0 .. 1.
[[nodiscard]] glm::u8vec3 heat_ramp(double position);

/// Makes the picture higher by the legend. Letters grow with the picture; a title that does not fit ends in "..".
void append_legend(LdrImage& image, const std::string& title, const HeatSummary& summary);

}  // namespace lamp::app
