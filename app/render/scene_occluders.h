// A scene's triangles for rays: those of opaque and masked surfaces, in world space.
// Promise: what a masked material's image cuts out at its finest level is not there. Glass is not there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/occluders.h"
#include "scene/scene.h"

namespace lamp::app {

/// Refers to the scene, which must outlive it. `first_levels`: of each image, the level that is read as its finest;
/// empty: 0, of all.
[[nodiscard]] Occluders scene_occluders(const Scene& scene, std::span<const std::uint32_t> first_levels = {});

/// Which sides of a triangle are drawn, and where it lies.
struct DrawnSides {
  glm::dvec3 normal{0.0};  ///< of its front, m^2
  bool both = false;
  std::uint32_t instance = 0;           ///< of the scene
  std::array<glm::dvec3, 3> corners{};  ///< in the world, m
};
/// Of each of their triangles.
[[nodiscard]] std::vector<DrawnSides> drawn_sides(const Scene& scene);

}  // namespace lamp::app
