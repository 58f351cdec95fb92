// Skinned meshes of a glTF file, in the pose that its nodes give their joints.
// Based on: Khronos, glTF 2.0 specification, section 3.7.3 (skins).
// Promise: positions are finite; front faces stay counter-clockwise where joints mirror.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_attributes.h"
#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/tangents.h"

namespace lamp::app {

/// Of each joint of a skin what takes vertices to the world: world_from_joint times the joint's inverse bind matrix.
using GltfPose = std::vector<glm::dmat4>;

/// The poses of a file's skins, made when they are asked for.
class GltfPoses {
 public:
  /// `nodes` must outlive it.
  GltfPoses(const GltfDocument& document, std::span<const PlacedNode> nodes);

  /// Valid until another one is asked for. Throws Error for a joint that is not in the scene, and for inverse bind
  /// matrices that are too few, too large or not affine.
  [[nodiscard]] const GltfPose& of(int skin);

 private:
  [[nodiscard]] GltfPose make(int skin) const;

  const GltfDocument& document_;
  std::vector<const PlacedNode*> placed_;  ///< by node; null: it is not in the scene
  GltfPose made_;
  int made_of_ = -1;
};

/// Takes the vertices of a skinned primitive to where their joints are in the world, and turns the triangles round that
/// these mirror. Notes say what was replaced. Throws Error.
void pose_triangles(const PrimitiveReader& reader, const GltfPose& pose, Triangles& triangles,
                    std::vector<std::string>& notes);

}  // namespace lamp::app
