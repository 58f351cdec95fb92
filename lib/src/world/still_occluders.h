// Polygons and a hierarchy of boxes over them, which finds those that are near a light and look large from it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "convex_polygons.h"

namespace lamp {

struct StillOccluders::State {
  struct Box {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
  };
  struct Node {
    Box box;
    double diameter = 0.0;    ///< m, of its largest polygon
    std::uint32_t first = 0;  ///< of `order`, or of two nodes
    std::uint32_t count = 0;  ///< 0: an inner node
  };

  std::vector<world::ConvexPolygon> polygons;
  std::vector<Box> boxes;  ///< one each
  std::vector<std::uint32_t> order;
  std::vector<Node> nodes;
  std::size_t left_out = 0;

  explicit State(world::MergedTriangles merged);

  /// Calls `found(polygon)` for all that have a part nearer than `range` and whose diameter is not less than `least` of
  /// their distance.
  template <class Found>
  void near(const glm::dvec3& position, double range, double least, const Found& found) const {
    if (nodes.empty()) return;
    std::uint32_t stack[128];
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes[stack[--depth]];
      if (!may_matter(node.box, node.diameter, position, range, least)) continue;
      if (node.count == 0) {
        stack[depth++] = node.first;
        stack[depth++] = node.first + 1;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (may_matter(boxes[order[i]], diameter_of(order[i]), position, range, least)) found(order[i]);
    }
  }

 private:
  [[nodiscard]] static bool may_matter(const Box& box, double diameter, const glm::dvec3& position, double range,
                                       double least) {
    const glm::dvec3 gap = glm::max(glm::max(box.min - position, position - box.max), glm::dvec3(0.0));
    const double distance = glm::length(gap);
    return distance <= range && diameter >= least * distance;
  }
  [[nodiscard]] double diameter_of(std::uint32_t polygon) const {
    return glm::distance(boxes[polygon].min, boxes[polygon].max);
  }
  [[nodiscard]] Node node_of(std::uint32_t first, std::uint32_t count) const;
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
};

}  // namespace lamp
