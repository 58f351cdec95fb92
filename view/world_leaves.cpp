// Down the tree, into what a box touches.
// SPDX-License-Identifier: Apache-2.0
#include "view/world_leaves.h"

#include <algorithm>
#include <bit>
#include <glm/glm.hpp>

#include "lamplight/shared/world_tree.h"

namespace lamp::app {
namespace {

constexpr float CELLS_ALONG = 4.0F;  // of a leaf, along each axis

/// In the finest cells there can be, from the root's low corner.
struct Part {
  glm::vec3 low{0.0F};
  glm::vec3 high{0.0F};
};

bool touch(const Part& part, const glm::vec3& low, float side) {
  return glm::all(glm::lessThan(part.low, low + side)) && glm::all(glm::greaterThan(part.high, low));
}

/// Calls `use` with low corner and side of every cube of one list that touches the part.
template <class Use>
void visit(std::span<const std::uint32_t> words, std::uint32_t node, const glm::vec3& low, float side, const Part& part,
           const Use& use) {
  if (!touch(part, low, side)) return;
  const std::uint32_t kind = node >> shared::TREE_KIND_BIT;
  if (kind == shared::TREE_INNER) {
    for (std::uint32_t child = 0; child < 8; ++child) {
      const glm::vec3 step(child & 1U, child >> 1U & 1U, child >> 2U);
      visit(words, words[(node & shared::TREE_PLACE) + child], low + 0.5F * side * step, 0.5F * side, part, use);
    }
    return;
  }
  if (kind != shared::TREE_CELLS) return use(low, side);
  const float cell = side / CELLS_ALONG;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const glm::vec3 at = low + cell * glm::vec3(i & 3U, i >> 2U & 3U, i >> 4U);
    if (touch(part, at, cell)) use(at, cell);
  }
}

}  // namespace

std::vector<WorldCell> leaves_around(std::span<const std::uint32_t> words, const glm::vec3& point) {
  const float scale = std::bit_cast<float>(words[shared::TREE_SCALE]);
  const glm::vec3 origin(std::bit_cast<float>(words[shared::TREE_LOW_X]),
                         std::bit_cast<float>(words[shared::TREE_LOW_Y]),
                         std::bit_cast<float>(words[shared::TREE_LOW_Z]));
  const float root = CELLS_ALONG * static_cast<float>(1U << words[shared::TREE_LEVELS]);
  const glm::vec3 at = glm::floor(point * scale - origin);  // of the finest cell, which lies in one cube
  std::vector<WorldCell> leaves;
  Part around;
  visit(words, words[shared::TREE_ROOT], glm::vec3(0.0F), root, {.low = at, .high = at + 1.0F},
        [&](const glm::vec3& low, float side) {
          around = {.low = low - CELLS_AROUND * side, .high = low + (1.0F + CELLS_AROUND) * side};
        });
  if (around.low == around.high) return leaves;
  visit(words, words[shared::TREE_ROOT], glm::vec3(0.0F), root, around, [&](const glm::vec3& low, float side) {
    leaves.push_back({.low = (origin + low) / scale, .side = side / scale});
  });
  const auto distance = [&](const WorldCell& leaf) {
    return glm::distance(point, glm::clamp(point, leaf.low, leaf.low + leaf.side));
  };
  std::ranges::sort(leaves, {}, distance);
  if (leaves.size() > MOST_LEAVES) leaves.resize(MOST_LEAVES);
  return leaves;
}

}  // namespace lamp::app
