// A tree of bricks with their lights, and what it takes to keep it within a budget: nodes whose children are merged.
// Based on: Breiman et al., Classification and Regression Trees (1984), chapter 3: the best pruned tree for a price.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light_cells.h"

namespace lamp::world {

/// One behind the other: the lights of a leaf, ascending, and the cells of each.
struct Entry {
  std::uint32_t light = 0;
  std::uint64_t cells = 0;
};

/// Lights in all cells of a node are in all cells below it, too: only the highest node that has them keeps them, for
/// all of its children.
struct BrickNode {
  std::uint64_t first = 0;     ///< of the entries
  std::uint32_t all = 0;       ///< lights in all of its cells that no node above it keeps
  std::uint32_t own = 0;       ///< as a leaf, the lights besides these and those above; behind them
  std::uint32_t children = 0;  ///< the first of 8; 0: none
  double walked = 0.0;         ///< as a leaf: how often its points are asked for, times the lights of an average cell
  std::uint64_t words = 0;     ///< as a leaf
};

/// Bricks at the finest level of each place at which they are worth their words at the least price, and what each
/// larger one would be without its children.
struct BrickTree {
  std::vector<BrickNode> nodes;  ///< the first is the root
  std::vector<Entry> entries;
  std::size_t peak_entries = 0;  ///< while it was made

  [[nodiscard]] std::span<const Entry> all_of(const BrickNode& node) const {
    return {entries.data() + node.first, node.all};
  }
  [[nodiscard]] std::span<const Entry> own_of(const BrickNode& node) const {
    return {entries.data() + node.first + node.all, node.own};
  }
};

/// `bricks` ascend by place, then level, then light; those of one light do not overlap. `surfaces`: places (Morton
/// codes) of points on surfaces, ascending, which are asked for as often as all the air together.
[[nodiscard]] BrickTree make_tree(std::span<const LitBrick> bricks, std::uint32_t levels,
                                  std::span<const std::uint64_t> surfaces);

/// Words of a leaf with so many lights.
[[nodiscard]] std::uint64_t leaf_words(std::uint64_t lights, bool plain);
[[nodiscard]] bool is_plain(std::span<const Entry> entries);

struct Pruned {
  std::vector<bool> leaves;  ///< of the nodes: whether it is one, unless it is below one
  std::uint64_t words = 0;
  double walked = 0.0;
};

/// The tree with the least walked of those that take no more words; without words for a root, the root.
[[nodiscard]] Pruned prune(const BrickTree& tree, std::uint64_t words);

}  // namespace lamp::world
