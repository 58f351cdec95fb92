// Look-ups of still lights on the host, pixel by pixel.
// SPDX-License-Identifier: Apache-2.0
#include "view/still_pixels.h"

#include <algorithm>

namespace lamp::app {

std::vector<std::uint32_t> StillPixels::lights_at(std::size_t pixel) const {
  if (!has(pixel)) return {};
  std::vector<std::uint32_t> found = made.lights_at(points[pixel]);
  for (std::uint32_t& light : found) light += first;
  return found;
}

StillFindings StillPixels::check(std::span<const std::size_t> pixels) const {
  std::vector<gpu::StillPoint> of_pixels;
  for (const std::size_t pixel : pixels)
    if (has(pixel)) of_pixels.push_back(points[pixel]);
  const std::span<const StillTriangle> triangles = made.triangles;
  return check_still_points({.context = context,
                             .shaders = shaders,
                             .triangles = made.tree ? std::span<const StillTriangle>() : triangles,
                             .lights = lights,
                             .list = [&](const gpu::StillPoint& point) { return made.lights_at(point); },
                             .on_gpu = on_gpu,
                             .occluders = occluders},
                            of_pixels);
}

}  // namespace lamp::app
