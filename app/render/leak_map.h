// Leaks of shadows in colour, over the scene in grey: light that a filter lets through although something stops it, and
// light that it stops although it arrives. Pure: no device.
// Promise: a larger share of a pixel's light is nearer to the full colour.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/shadow_leaks.h"

namespace lamp::app {

/// Orange and blue differ for all kinds of colour vision.
struct LeakColors {
  glm::u8vec3 leaked{255, 120, 0};
  glm::u8vec3 lost{40, 130, 255};
  glm::u8vec3 unknown{255, 0, 200};  ///< the device ended the pixel's search
};

/// What the lights make of each pixel with the filter's shadows, as a grey. Sky is darker than all.
[[nodiscard]] std::vector<std::uint8_t> grey_of(std::span<const gpu::ShadowLeak> pixels);

/// A pixel's colour over a grey: by the root of the share of its light without shadows, so that a hundredth shows.
[[nodiscard]] glm::u8vec3 leak_color(const gpu::ShadowLeak& pixel, std::uint8_t grey, const LeakColors& colors);

/// "leaks: 27.37 % of the light that rays stop"
[[nodiscard]] std::string leak_words(const LeakSums& sums);
/// "false shadows: 0.53 % of the light that arrives"
[[nodiscard]] std::string lost_words(const LeakSums& sums);
/// "left out: 12 pairs of pixel and light whose rays are unclear, and 3 pixels ..."; empty: nothing was.
[[nodiscard]] std::string left_out_words(const LeakSums& sums);

struct LeakMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const gpu::ShadowLeak> pixels;
  std::string title;
  const LdrImage* overlay = nullptr;  ///< not null: its grey is the map's, instead of grey_of
};
/// With a legend below: what the colours mean, and the picture's sums.
[[nodiscard]] LdrImage draw_leak_map(const LeakMap& map);

}  // namespace lamp::app
