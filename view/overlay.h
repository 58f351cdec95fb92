// What is laid over the picture, from what the walks of its pixels met. Pure: no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "commands/view_state.h"
#include "render/visit.h"

namespace lamp::app {

/// A frame's walks and depth, row by row.
struct Walked {
  const View& view;
  std::span<const Visit> visits;
  std::span<const float> depth;  ///< device depth, for Overlay::depth_range
  std::uint32_t lights = 0;      ///< of the frame
  bool overflowed = false;       ///< some cells did not fit
  double scale_max = 0.0;        ///< the top of the scale; 0: from what is walked
};

/// How the colours of an overlay are to be read.
struct Legend {
  Overlay overlay = Overlay::none;
  double low = 0.0;  ///< of the scale; lights, or metres
  double high = 0.0;
  double mean = 0.0;
  double max = 0.0;
  std::uint64_t cells = 0;  ///< that hold pixels; of Overlay::overflow, pixels that walk every light; of
                            ///< Overlay::missed, pixels that miss one, and `max` is of how many pairs
};

/// RGBA of every pixel, eight bits each, red lowest. Alpha 0 leaves the picture as it is.
struct Overlaid {
  std::vector<std::uint32_t> pixels;
  Legend legend;
};
[[nodiscard]] Overlaid make_overlay(Overlay overlay, Palette palette, const Walked& walked);

/// A colour of the scale, at 0 .. 1.
[[nodiscard]] glm::u8vec3 palette_color(Palette palette, double position);

}  // namespace lamp::app
