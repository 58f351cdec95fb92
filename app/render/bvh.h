// A bounding volume hierarchy of a scene's triangles, to find in compute what a ray meets: one over the triangles of
// each mesh, and one over instances, which alone changes where instances move. Based on: Wald, On fast Construction of
// SAH-based Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing (2007): bins; Kay, Kajiya, Ray
// Tracing Complex Scenes, SIGGRAPH (1986). Promise: the same for the same scene on every machine. Every triangle of an
// opaque or masked surface is in it once for each mesh; glass is not. Boxes hold their triangles, and more by what
// 32-bit rays may be off. No ray has a path deeper than `stack`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/shaders/bvh_data.h"
#include "scene/scene.h"

namespace lamp::app {

struct Bvh {
  std::vector<gpu::BvhNode> nodes;  ///< the meshes', then those of the upper level, parents before children
  std::vector<gpu::BvhTriangle> triangles;
  std::vector<gpu::BvhInstance> instances;
  std::vector<Box> boxes;  ///< of each instance: of its triangles, in the space that they are in
  std::uint32_t root = gpu::BVH_NOTHING;
  std::uint32_t first_upper = 0;  ///< of the upper level's nodes
  std::uint32_t stack = 0;        ///< as many nodes may wait at once
};

[[nodiscard]] Bvh make_bvh(const Scene& scene);

/// The same scene's, whose instances have moved: boxes of the upper level are made anew, its tree stays. Where a matrix
/// has or had no inverse, all is built anew. True: only instances and the upper level's nodes are others than before.
bool refit(Bvh& bvh, const Scene& scene);

/// A tree over boxes, for one level.
struct BoxTree {
  std::vector<gpu::BvhNode> nodes;   ///< parents before children
  std::vector<std::uint32_t> order;  ///< the boxes, as leaves count them
  std::uint32_t root = gpu::BVH_NOTHING;
  std::uint32_t depth = 0;  ///< of inner nodes, one below the other
};
struct BoxTreeInfo {
  std::uint32_t leaf = 4;       ///< boxes of a leaf, at most; below BVH_COUNTS
  std::uint32_t max_depth = 0;  ///< kept, unless so many boxes do not fit
};
[[nodiscard]] BoxTree make_box_tree(std::span<const Box> boxes, const BoxTreeInfo& info);

}  // namespace lamp::app
