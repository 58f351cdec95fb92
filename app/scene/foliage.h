// Trees and plants of procedural scenes: crowns of leaf cards, single leaves, trunks with branches, reeds.
// Based on: nothing.
// Promise: deterministic from the seed; leaves are single sheets for double-sided materials.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/mesh_builder.h"

namespace lamp::app::procedural {

/// Square cards all over a ball, each showing a random part of an alpha-masked image of leaves.
struct Crown {
  glm::vec3 center{0.0F};
  float radius = 1.0F;  ///< m
  int cards = 100;
  float card_m = 0.35F;  ///< mean side of a card
  std::uint64_t seed = 1;
};
void add_crown(Geometry& geometry, const Crown& crown);

/// A slender tree from y = 0: its wood, its single leaves (diamonds), and the places of its twigs' ends.
struct SlenderTree {
  float height = 6.0F;
  float radius = 0.045F;  ///< m, at the foot
  int branches = 7;
  int leaves = 90;
  float leaf_m = 0.09F;
  std::uint64_t seed = 1;
};
struct TreeParts {
  Geometry wood;
  Geometry leaves;
  std::vector<glm::vec3> twigs;
};
[[nodiscard]] TreeParts slender_tree(const SlenderTree& tree);

/// A clump of reeds around the origin: stems, heads and long bent blades.
struct ReedClump {
  int stems = 10;
  float height = 2.2F;
  float spread = 0.5F;  ///< m
  std::uint64_t seed = 1;
};
struct ReedParts {
  Geometry stems;
  Geometry heads;
  Geometry blades;
};
[[nodiscard]] ReedParts reed_clump(const ReedClump& clump);

}  // namespace lamp::app::procedural
