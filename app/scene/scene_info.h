// What a scene holds, in numbers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "scene/scene.h"

namespace lamp::app {

/// Lights of one type.
struct LightCount {
  std::size_t count = 0;
  std::size_t unlimited = 0;  ///< of these, how many reach everything
  float min_range = 0.0F;     ///< m, of the others
  float max_range = 0.0F;     ///< m, of the others
};

struct SceneInfo {
  LightCount points;
  LightCount spots;
  std::optional<Box> bounds;         ///< of all surfaces; of a capture, of what it shows
  std::uint64_t triangles = 0;       ///< drawn: a mesh counts as often as it stands in the scene
  std::uint64_t geometry_bytes = 0;  ///< vertices and indices
  std::uint64_t image_bytes = 0;     ///< of textures, without their smaller levels
  std::size_t transparent = 0;       ///< materials that are blended
  std::uint64_t covered_pixels = 0;  ///< of a capture: pixels that are not sky
};

[[nodiscard]] SceneInfo describe(const Scene& scene);

}  // namespace lamp::app
