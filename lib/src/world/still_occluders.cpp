// Builds the hierarchy: halves along the longest side, at the median.
// SPDX-License-Identifier: Apache-2.0
#include "still_occluders.h"

#include <algorithm>
#include <array>
#include <cmath>
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

std::vector<DVec3> StillOccluders::points_on(const DVec3& min, const DVec3& max, std::size_t count) const {
  std::vector<double> areas;  // of the fans' triangles, summed up
  std::vector<std::array<glm::dvec3, 3>> triangles;
  double sum = 0.0;
  for (std::size_t i = 0; i < state_->polygons.size(); ++i) {
    const State::Box& box = state_->boxes[i];
    const glm::dvec3 gap = glm::max(box.min - glm::dvec3(max), glm::dvec3(min) - box.max);
    if (std::max({gap.x, gap.y, gap.z}) > 0.0) continue;
    const std::vector<glm::dvec3>& corners = state_->polygons[i].corners;
    for (std::size_t c = 2; c < corners.size(); ++c) {
      sum += 0.5 * glm::length(glm::cross(corners[c - 1] - corners[0], corners[c] - corners[0]));
      areas.push_back(sum);
      triangles.push_back({corners[0], corners[c - 1], corners[c]});
    }
  }
  std::vector<DVec3> points;
  for (std::size_t i = 0; i < count && sum > 0.0 && std::isfinite(sum); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto at = std::ranges::lower_bound(areas, share * sum);
    if (at == areas.end()) break;
    // Two low-discrepancy numbers, folded into the triangle: Roberts, The Unreasonable Effectiveness of Quasirandom
    // Sequences (2018).
    const auto number = static_cast<double>(i);
    double u = number * 0.7548776662466927 - std::floor(number * 0.7548776662466927);
    double v = number * 0.5698402909980532 - std::floor(number * 0.5698402909980532);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(at - areas.begin())];
    points.emplace_back(a + u * (b - a) + v * (c - a));
  }
  return points;
}

}  // namespace lamp
