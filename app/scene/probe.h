// Reflection probes as every source of scenes describes them: whose surfaces one lights, the walls that it stands for,
// and where it is captured.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace lamp::app {

enum class ProbeShape : std::uint8_t { box, ellipsoid };

struct Probe {
  ProbeShape shape = ProbeShape::box;             ///< of both volumes
  glm::vec3 center{0.0F};                         ///< m, world space: of the volume whose surfaces it lights
  glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit; of both volumes
  glm::vec3 half_extents{1.0F};                   ///< m, > 0; of an ellipsoid the half axes
  float blend_m = 0.0F;                   ///< from the volume's surface inwards, >= 0: there its weight rises to 1
  glm::vec3 parallax_center{0.0F};        ///< m, world space: of the volume whose surface stands for the walls
  glm::vec3 parallax_half_extents{1.0F};  ///< m, > 0
  glm::vec3 capture{0.0F};                ///< m, world space: where it is captured
};

/// m^3, of the volume whose surfaces it lights.
[[nodiscard]] double volume_of(const Probe& probe);

/// The order in which a surface takes probes: ascending volume, then as they were made. Their numbers, in that order.
/// Ids follow it, and nothing else decides it.
[[nodiscard]] std::vector<std::uint32_t> by_volume(const std::vector<Probe>& probes);

}  // namespace lamp::app
