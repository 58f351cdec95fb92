// The heat map: how many lights the cell of each pixel holds, on a logarithmic scale, with a legend in the picture.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), figures 1.5, 1.8 and 1.9.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "image/image.h"
#include "render/shaders/sky_cell.h"

namespace lamp::app {

using gpu::SKY_CELL;

/// A number that is none, but says something that shall be seen.
struct HeatSignal {
  std::uint32_t count = 0;
  glm::u8vec3 color{0};
  std::string meaning;  ///< stands in the legend if a pixel has it
};

struct Heatmap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::uint32_t> counts;  ///< width * height: lights in the pixel's cell; SKY_CELL is drawn dark
  std::uint32_t scale_max = 0;            ///< lights at the top of the scale; 0: the next power of two over the largest
  std::string title;                      ///< drawn into the picture ("tiled, 4096 lights")
  const LdrImage* overlay = nullptr;      ///< not null: the map is laid over this picture
  std::string unit = "lights";            ///< of what is counted
  std::span<const HeatSignal> signals;    ///< neither mean nor maximum knows them
};

/// The colour of a count on the scale 1 .. scale_max (log2), 0 black.
[[nodiscard]] glm::u8vec3 heat_color(std::uint32_t count, std::uint32_t scale_max);

/// The map with its log-scale legend, tick numbers, title, mean and maximum drawn below or beside it.
[[nodiscard]] LdrImage draw_heatmap(const Heatmap& map);

}  // namespace lamp::app
