// Which cells a light may light: sphere, cone and occlusion against boxes, from the root of the tree down.
// Promise: a cell that is left out is not reached, or proved dark, in all of it and a little around it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "lamplight/occlusion.h"
#include "lamplight/shared/light.h"

namespace lamp::world {

/// Cells of a tree: a cube of 4 * 2^levels of them from `low` on. A brick is 4 x 4 x 4 cells of a level; those of level
/// `levels` are the finest, and the one of level 0 is the root.
struct TreeGrid {
  glm::dvec3 low{0.0};  ///< in finest cells, exact as floats
  double cell_m = 1.0;  ///< of the finest; a power of two
  std::uint32_t levels = 0;
  double eyes_m = 0.0;  ///< as in WorldTreeInfo

  [[nodiscard]] double brick_m(std::uint32_t level) const;
  [[nodiscard]] glm::dvec3 corner(std::uint32_t level, const glm::uvec3& brick) const;
  [[nodiscard]] double side_m() const { return brick_m(0); }
  [[nodiscard]] double slack_m() const;  ///< what rounding may move a position in or near the root
};

/// What rounding moves a position that an eye so far from the origin sees.
[[nodiscard]] double eye_slack_m(double eyes_m);

/// A brick that a light is in; bit x + 4 y + 16 z of its cells is set where it may light something.
struct LitBrick {
  std::uint64_t place = 0;  ///< Morton code of its low corner, in finest bricks
  std::uint64_t cells = 0;
  std::uint32_t level = 0;
  std::uint32_t light = 0;
};

inline constexpr std::uint64_t ALL_CELLS = ~0ULL;

/// The bit of a brick's cell.
[[nodiscard]] constexpr std::uint32_t cell_bit(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return x + 4U * (y + 4U * z);
}

/// Bits of x, y and z in turn, x the lowest; 20 bits each.
[[nodiscard]] std::uint64_t morton(const glm::uvec3& v);

/// A light, and what it sees.
class LightCells {
 public:
  explicit LightCells(std::uint32_t texels) : map_(texels) {}

  /// `occluders` may be null.
  void look(const shared::Light& light, const TreeGrid& grid, const StillOccluders* occluders);

  /// Appends the bricks of a level that the light may light, or coarser ones where it lights all of them.
  void add_bricks(std::uint32_t finest, std::uint32_t id, std::vector<LitBrick>& to) const;
  /// The cells of a brick.
  [[nodiscard]] std::uint64_t cells(std::uint32_t level, const glm::uvec3& brick) const;
  /// Whether it reaches something outside of the root.
  [[nodiscard]] bool leaves_root() const;
  [[nodiscard]] bool reaches_brick(std::uint32_t level, const glm::uvec3& brick) const;

 private:
  enum class Lit : std::uint8_t { none, partly, all };
  struct Cube {
    glm::dvec3 low;
    double side;
  };
  [[nodiscard]] Lit reach(const Cube& cube) const;
  [[nodiscard]] Lit lit(const Cube& cube) const;
  void descend(std::uint32_t level, const glm::uvec3& brick, std::uint32_t finest, std::uint32_t id,
               std::vector<LitBrick>& to) const;

  TreeGrid grid_;
  shared::Light light_{};
  glm::dvec3 center_{0.0};
  glm::dvec3 axis_{0.0};
  double range_ = -1.0;  ///< m, widened; negative: reaches nothing
  double slack_ = 0.0;
  bool has_map_ = false;
  OcclusionMap map_;
};

}  // namespace lamp::world
