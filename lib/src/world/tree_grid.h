// Where the cells of a tree lie, and how fine they are for each light.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "lamplight/world_tree.h"
#include "light_cells.h"

namespace lamp::world {

/// For all lights but those of infinite range and those that reach very much farther than the others lie apart.
[[nodiscard]] TreeGrid grid_of(const WorldTreeInfo& info);

/// The level of a light's bricks: cells of at most its range / info.detail, coarser where all lights' would not fit
/// several times the budget.
class BrickLevels {
 public:
  BrickLevels(const WorldTreeInfo& info, const TreeGrid& grid);
  [[nodiscard]] std::uint32_t of(const shared::Light& light) const;
  [[nodiscard]] double detail() const { return detail_; }

 private:
  [[nodiscard]] double reach_m(const shared::Light& light) const;  ///< widened by rounding; no farther than the root

  TreeGrid grid_;
  double detail_;
};

}  // namespace lamp::world
