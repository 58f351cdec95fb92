// The patches of one triangle: squares seen along the axis that its plane faces most, in tables of tables.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lamplight/triangle_lists.h"
#include "still_light.h"

namespace lamp::world {

/// What all triangles of a build share.
struct Patching {
  std::span<const StillLight> lights;
  const Hides* hides = nullptr;  ///< null: nothing hides anything
  double slack = 0.0;            ///< m, of the positions
  double patch = 0.25;           ///< side over range
  std::function<void(std::size_t word, std::vector<std::uint32_t> list)> found;
  std::function<bool()> is_too_much;  ///< then the rest of all patches is left out
};

/// Where a triangle's tables go, and what is counted of them.
struct PatchTables {
  std::vector<std::uint32_t>& words;
  TriangleListsStats& stats;
};

/// Fills the word of a triangle, which is there, and appends its tables: lists of `near`, ascending, go to `found`.
void make_patches(const Patching& how, const StillTriangle& triangle, std::span<const std::uint32_t> near,
                  std::size_t word, PatchTables& tables);

/// From word `word` on, down the tables, to the name of the list of a position.
[[nodiscard]] std::uint32_t list_name(std::span<const std::uint32_t> words, std::uint32_t word, const Vec3& position);

}  // namespace lamp::world
