// What stands between a light and a point: rays against triangles, in double precision, on the CPU.
// Based on: Moeller, Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997); a hierarchy of boxes split at
// the median. Promise: the hierarchy only skips triangles that a plain loop would not hit either.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace lamp {

/// World space, m; both sides count.
struct Triangle {
  std::array<glm::dvec3, 3> corners;
};

/// From `from` to `to`; what lies at a share of the way from first to last, both included, is met.
struct Ray {
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  double first = 0.0;
  double last = 1.0;
};

struct Hit {
  double at = 0.0;  ///< share of the way
  std::uint32_t triangle = 0;
  double u = 0.0;  ///< the weights of the second and the third corner
  double v = 0.0;
};

class Occluders {
 public:
  /// Whether a triangle is there at a point of it: what is cut out of a masked surface is not.
  using IsThere = std::function<bool(std::uint32_t triangle, double u, double v)>;

  explicit Occluders(std::vector<Triangle> triangles, IsThere is_there = {});

  /// Whether a hit counts: of a surface with one side, that from its front does.
  using Counts = std::function<bool(const Hit& hit)>;

  /// Of hits at one place, any.
  [[nodiscard]] std::optional<Hit> first_hit(const Ray& ray, const Counts& counts = {}) const;
  [[nodiscard]] bool any_hit(const Ray& ray) const;
  /// The same by a plain loop, for tests.
  [[nodiscard]] std::optional<Hit> first_hit_of_all(const Ray& ray) const;

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

 private:
  struct Box {
    glm::dvec3 min{0.0};
    glm::dvec3 max{0.0};
  };
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< of `order_`, or of two nodes
    std::uint32_t count = 0;  ///< 0: an inner node
  };
  [[nodiscard]] Box box_of(std::uint32_t first, std::uint32_t count) const;
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  [[nodiscard]] std::optional<Hit> meet(std::uint32_t triangle, const Ray& ray) const;
  template <class Found>
  void walk(const Ray& ray, Found found) const;

  std::vector<Triangle> triangles_;
  IsThere is_there_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lamp
