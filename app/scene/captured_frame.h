// What a camera saw, pixel by pixel: stands in for a scene's meshes when its source is a capture.
// Promise: no more than a G-buffer holds; positions follow from the depth.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lamplight/view.h"

namespace lamp::app {

/// The brightest emission there can be: it is shaded from half floats.
inline constexpr float LARGEST_EMISSION = 65504.0F;

/// All vectors have a value for each pixel, row by row from the top. Where the depth says sky, the others say nothing.
struct CapturedFrame {
  View view;
  std::vector<float> depth;         ///< device depth, reversed: 0 is sky, else (0, 1]
  std::vector<glm::vec3> albedo;    ///< linear Rec. 709, 0 .. 1
  std::vector<glm::vec3> normal;    ///< world space, unit
  std::vector<glm::vec3> material;  ///< metallic, perceptual roughness, occlusion, 0 .. 1
  std::vector<glm::vec3> emission;  ///< radiance, 0 .. LARGEST_EMISSION
};

/// Normals of the surface that a depth buffer shows: across the nearer of the neighbours left and right, above and
/// below; towards the eye. World space; 0 for sky.
[[nodiscard]] std::vector<glm::vec3> normals_from_depth(const View& view, const std::vector<float>& depth);

}  // namespace lamp::app
