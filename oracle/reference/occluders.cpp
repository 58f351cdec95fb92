// Builds and walks the hierarchy of triangles.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/occluders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamp {
namespace {

constexpr std::uint32_t LEAF_TRIANGLES = 4;
constexpr double BOX_ROOM = 1e-9;  // of the size of a box and its distance from 0: far more than rounding

/// A direction without zeros, for its inverse.
glm::dvec3 inverse_of(const glm::dvec3& direction) {
  constexpr double LEAST = 1e-290;
  glm::dvec3 inverse;
  for (int i = 0; i < 3; ++i)
    inverse[i] = 1.0 / (std::abs(direction[i]) < LEAST ? std::copysign(LEAST, direction[i]) : direction[i]);
  return inverse;
}

/// False of what is not a number.
bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

Occluders::Occluders(std::vector<Triangle> triangles, IsThere is_there)
    : triangles_(std::move(triangles)), is_there_(std::move(is_there)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

Occluders::Box Occluders::box_of(std::uint32_t first, std::uint32_t count) const {
  Box box{triangles_[order_[first]].corners[0], triangles_[order_[first]].corners[0]};
  for (std::uint32_t i = first; i < first + count; ++i)
    for (const glm::dvec3& corner : triangles_[order_[i]].corners) {
      box.min = glm::min(box.min, corner);
      box.max = glm::max(box.max, corner);
    }
  const glm::dvec3 room = BOX_ROOM * (box.max - box.min + glm::max(glm::abs(box.min), glm::abs(box.max)) + 1e-30);
  return {box.min - room, box.max + room};
}

void Occluders::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  nodes_[node].box = box_of(first, count);
  if (count <= LEAF_TRIANGLES) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const glm::dvec3 size = nodes_[node].box.max - nodes_[node].box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle = [&](std::uint32_t triangle) {
    const auto& c = triangles_[triangle].corners;
    return c[0][axis] + c[1][axis] + c[2][axis];
  };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  build(children, first, count / 2);
  build(children + 1, first + count / 2, count - count / 2);
}

std::optional<Hit> Occluders::meet(std::uint32_t triangle, const Ray& ray) const {
  const auto& [a, b, c] = triangles_[triangle].corners;
  const glm::dvec3 way = ray.to - ray.from;
  const glm::dvec3 p = glm::cross(way, c - a);
  const double determinant = glm::dot(b - a, p);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 from_a = ray.from - a;
  const double u = glm::dot(from_a, p) / determinant;
  if (!within(u, 0.0, 1.0)) return std::nullopt;
  const glm::dvec3 q = glm::cross(from_a, b - a);
  const double v = glm::dot(way, q) / determinant;
  if (!within(v, 0.0, 1.0 - u)) return std::nullopt;
  const double at = glm::dot(c - a, q) / determinant;
  if (!within(at, ray.first, ray.last)) return std::nullopt;
  if (is_there_ && !is_there_(triangle, u, v)) return std::nullopt;
  return Hit{.at = at, .triangle = triangle, .u = u, .v = v};
}

/// `found(hit)` returns up to which share of the way further hits matter.
template <class Found>
void Occluders::walk(const Ray& ray, Found found) const {
  if (nodes_.empty()) return;
  Ray left = ray;
  const glm::dvec3 inverse = inverse_of(ray.to - ray.from);
  std::array<std::uint32_t, 96> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    const glm::dvec3 t0 = (node.box.min - ray.from) * inverse;
    const glm::dvec3 t1 = (node.box.max - ray.from) * inverse;
    const glm::dvec3 low = glm::min(t0, t1);
    const glm::dvec3 high = glm::max(t0, t1);
    if (std::max({low.x, low.y, low.z, left.first}) > std::min({high.x, high.y, high.z, left.last})) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (const auto hit = meet(order_[i], left)) left.last = found(*hit);
  }
}

std::optional<Hit> Occluders::first_hit(const Ray& ray, const Counts& counts) const {
  std::optional<Hit> first;
  walk(ray, [&](const Hit& hit) {
    const bool is_nearer = !first || hit.at < first->at;
    if (is_nearer && (!counts || counts(hit))) first = hit;
    return first ? first->at : ray.last;
  });
  return first;
}

bool Occluders::any_hit(const Ray& ray) const {
  bool any = false;
  walk(ray, [&](const Hit&) {
    any = true;
    return -1.0;  // nothing else matters
  });
  return any;
}

std::optional<Hit> Occluders::first_hit_of_all(const Ray& ray) const {
  std::optional<Hit> first;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    if (const auto hit = meet(i, ray); hit && (!first || hit->at < first->at)) first = hit;
  return first;
}

}  // namespace lamp
