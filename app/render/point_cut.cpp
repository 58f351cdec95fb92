// Asks at the centres of pixels.
// SPDX-License-Identifier: Apache-2.0
#include "render/point_cut.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "render/heatmap.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LONGER_SIDE_PX = 960;

}  // namespace

LdrImage draw_point_cut(PointWalks& walks, const Box& bounds, float height_m, const std::string& title) {
  const glm::vec2 low(bounds.min.x, bounds.min.z);
  const glm::vec2 size = glm::max(glm::vec2(bounds.max.x, bounds.max.z) - low, glm::vec2(1e-3F));
  const float pixel_m = std::max(size.x, size.y) / LONGER_SIDE_PX;
  const auto width = static_cast<std::uint32_t>(std::ceil(size.x / pixel_m));
  const auto height = static_cast<std::uint32_t>(std::ceil(size.y / pixel_m));
  std::vector<glm::vec3> points;
  points.reserve(std::size_t{width} * height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::vec2 at = low + (glm::vec2(x, y) + 0.5F) * pixel_m;
      points.emplace_back(at.x, height_m, at.y);
    }
  const PointLights found = walks.walk(points);
  std::vector<std::uint32_t> counts;
  counts.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    counts.push_back(found.ended[i] != 0 ? SKY_CELL : static_cast<std::uint32_t>(found.of(i).size()));
  return draw_heatmap({.width = width, .height = height, .counts = counts, .title = title});
}

}  // namespace lamp::app
