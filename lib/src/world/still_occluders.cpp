// Builds the hierarchy: halves along the longest side, at the median.
// SPDX-License-Identifier: Apache-2.0
#include "still_occluders.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lamp {
namespace {

constexpr std::uint32_t NODE_POLYGONS = 4;

}  // namespace

StillOccluders::State::State(world::MergedTriangles merged)
    : polygons(std::move(merged.polygons)), order(polygons.size()), left_out(merged.left_out) {
  boxes.reserve(polygons.size());
  for (const world::ConvexPolygon& polygon : polygons) {
    Box box{polygon.corners[0], polygon.corners[0]};
    for (const glm::dvec3& corner : polygon.corners) {
      box.min = glm::min(box.min, corner);
      box.max = glm::max(box.max, corner);
    }
    boxes.push_back(box);
  }
  std::iota(order.begin(), order.end(), 0U);
  if (polygons.empty()) return;
  nodes.reserve(polygons.size());
  nodes.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(polygons.size()));
}

StillOccluders::State::Node StillOccluders::State::node_of(std::uint32_t first, std::uint32_t count) const {
  Node node{.box = boxes[order[first]], .first = first, .count = count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    node.box.min = glm::min(node.box.min, boxes[order[i]].min);
    node.box.max = glm::max(node.box.max, boxes[order[i]].max);
    node.diameter = std::max(node.diameter, diameter_of(order[i]));
  }
  return node;
}

void StillOccluders::State::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  nodes[node] = node_of(first, count);
  if (count <= NODE_POLYGONS) return;
  const glm::dvec3 size = nodes[node].box.max - nodes[node].box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle = [&](std::uint32_t polygon) { return boxes[polygon].min[axis] + boxes[polygon].max[axis]; };
  const auto begin = order.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
  const auto children = static_cast<std::uint32_t>(nodes.size());
  nodes.resize(nodes.size() + 2);
  nodes[node].first = children;
  nodes[node].count = 0;
  build(children, first, count / 2);
  build(children + 1, first + count / 2, count - count / 2);
}

StillOccluders::StillOccluders(std::span<const OccluderTriangle> triangles)
    : state_(std::make_unique<State>(world::merge_triangles(triangles))) {}
StillOccluders::StillOccluders(StillOccluders&&) noexcept = default;
StillOccluders& StillOccluders::operator=(StillOccluders&&) noexcept = default;
StillOccluders::~StillOccluders() = default;

std::size_t StillOccluders::polygons() const { return state_->polygons.size(); }
std::size_t StillOccluders::left_out() const { return state_->left_out; }

}  // namespace lamp
