// The leaves of a world tree around a point, as large as they are: where a leaf's cells have one list, it is one cube.
// Promise: pure, no device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "view/world_lists.h"

namespace lamp::app {

/// Of WorldTree::words. Those that lie within CELLS_AROUND times the size of the point's own, nearest first and at most
/// MOST_LEAVES; none where the point lies outside of the tree. How many lights they have is not looked up.
[[nodiscard]] std::vector<WorldCell> leaves_around(std::span<const std::uint32_t> words, const glm::vec3& point);
inline constexpr std::size_t MOST_LEAVES = 1000;  // more are a tangle

}  // namespace lamp::app
