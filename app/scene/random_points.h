// Random points of a scene, to ask which lights reach them: on its surfaces, in the air, anywhere, and far away.
// Promise: the same points for the same seed on every machine.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scene/open_air.h"

namespace lamp::app {

enum class PointKind : std::uint8_t {
  near_surface,  ///< on surfaces within 100 m of the eye
  surface,       ///< on all surfaces
  air,           ///< where generated lights can be
  anywhere,      ///< in three times the scene's bounds
  far,           ///< 100 km away, in any direction
};
inline constexpr PointKind POINT_KINDS[] = {PointKind::near_surface, PointKind::surface, PointKind::air,
                                            PointKind::anywhere, PointKind::far};
/// "surfaces within 100 m", "surfaces", "open air", "anywhere", "100 km away".
[[nodiscard]] std::string_view name_of(PointKind kind);

/// Draws points of a scene, each area of its surfaces as often as any other.
class PointSource {
 public:
  PointSource(const Scene& scene, OpenAir air, const glm::vec3& eye);

  /// None where the scene has no such points: no surfaces, or none near the eye.
  [[nodiscard]] std::vector<glm::vec3> draw(PointKind kind, std::size_t count, std::uint64_t seed) const;

 private:
  struct Facet {
    glm::vec3 corner, u, v;  ///< corner + a u + b v
    double area_before = 0;  ///< m^2, of all facets before
  };
  struct Surfaces {
    std::vector<Facet> facets;
    double area = 0;
  };
  static void add(Surfaces& to, Facet facet);
  [[nodiscard]] static glm::vec3 draw(const Surfaces& from, double share, glm::vec2 place);

  OpenAir air_;
  Box bounds_;
  glm::vec3 eye_;
  Surfaces all_;
  Surfaces near_;  ///< those that may be within reach of the eye
};

}  // namespace lamp::app
