// Makes the tree from the root down, its nodes' own lists from the leaves up, and drops children as soon as their
// parent is better without them.
// SPDX-License-Identifier: Apache-2.0
#include "brick_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

namespace lamp::world {
namespace {

/// Calls `visit(bit, first)` for the 8 cells of a brick that a child of it is made of: the cell's bit, and the first
/// bit of the child's 2 x 2 x 2 cells in it.
template <class Visit>
void for_each_cell_of_child(std::uint32_t child, const Visit& visit) {
  const std::uint32_t corner = cell_bit(2U * (child & 1U), 2U * (child >> 1U & 1U), 2U * (child >> 2U));
  for (std::uint32_t c = 0; c < 8; ++c) {
    const std::uint32_t x = c & 1U;
    const std::uint32_t y = c >> 1U & 1U;
    const std::uint32_t z = c >> 2U;
    visit(corner + cell_bit(x, y, z), cell_bit(2 * x, 2 * y, 2 * z));
  }
}

/// The cells of a brick's child.
std::uint64_t cells_of_child(std::uint64_t cells, std::uint32_t child) {
  if (cells == ALL_CELLS) return ALL_CELLS;
  constexpr std::uint64_t TWO_CUBED = 0x330033ULL;
  std::uint64_t found = 0;
  for_each_cell_of_child(child, [&](std::uint32_t bit, std::uint32_t first) {
    if ((cells >> bit & 1U) != 0) found |= TWO_CUBED << first;
  });
  return found;
}

/// The cells of a brick that hold some of its child's.
std::uint64_t cells_of_parent(std::uint64_t cells, std::uint32_t child) {
  cells |= cells >> 1U;
  cells |= cells >> 4U;
  cells |= cells >> 16U;
  std::uint64_t found = 0;
  for_each_cell_of_child(child, [&](std::uint32_t bit, std::uint32_t first) {
    if ((cells >> first & 1U) != 0) found |= 1ULL << bit;
  });
  return found;
}

// Leaves that agree merge, and those that nearly do: 64 MiB of them are worth a sixtieth of a light at a point.
constexpr double LEAST_PRICE = 1e-9;
constexpr double CHILDREN_WORDS = 8.0;

double cost_as_leaf(const BrickNode& node, double price) {
  return node.walked + price * static_cast<double>(node.words);
}

/// What is so at a price is so at every higher one: the node is walked no less than what is below it, so it can only be
/// better for its fewer words.
bool is_better_as_leaf(double as_leaf, double below) { return as_leaf <= below * (1.0 + 1e-12); }

class Making {
 public:
  Making(std::span<const LitBrick> bricks, std::uint32_t levels, std::span<const std::uint64_t> surfaces)
      : bricks_(bricks), levels_(levels), surfaces_(surfaces) {}

  BrickTree run() {
    tree_.nodes.emplace_back();
    node(0, {}, {}, bricks_);
    return std::move(tree_);
  }

 private:
  using Entries = std::vector<Entry>;
  struct Place {
    std::uint32_t level = 0;
    std::uint64_t corner = 0;  ///< the low one
    std::uint64_t all = 0;     ///< lights in all of its cells that nodes above it keep
  };

  /// `from_above`: lights of coarser bricks in some of its cells. `bricks`: those in it. The cost at the least price.
  double node(std::uint32_t number, Place place, const Entries& from_above, std::span<const LitBrick> bricks) {
    const auto deeper = std::ranges::find_if(bricks, [&](const LitBrick& b) { return b.level != place.level; });
    Entries at_level;
    for (auto brick = bricks.begin(); brick != deeper; ++brick)
      at_level.push_back({.light = brick->light, .cells = brick->cells});
    Entries own;
    std::ranges::merge(from_above, at_level, std::back_inserter(own), {}, &Entry::light, &Entry::light);
    Entries all;
    std::ranges::copy_if(own, std::back_inserter(all), [](const Entry& e) { return e.cells == ALL_CELLS; });
    std::erase_if(own, [](const Entry& e) { return e.cells == ALL_CELLS; });
    place.all += all.size();
    const std::span<const LitBrick> rest(deeper, bricks.end());
    const auto first_child = static_cast<std::uint32_t>(tree_.nodes.size());
    const std::size_t first_entry = tree_.entries.size();
    double below = std::numeric_limits<double>::infinity();
    if (!rest.empty()) {
      tree_.nodes.resize(first_child + std::size_t{8});
      below = split(first_child, place, own, rest);
      own = merged(first_child);
    }
    BrickNode made = leaf(place, own);
    const double as_leaf = cost_as_leaf(made, LEAST_PRICE);
    const bool keeps_children = !is_better_as_leaf(as_leaf, below);
    if (keeps_children) {
      made.children = first_child;
    } else {
      tree_.nodes.resize(first_child);
      tree_.entries.resize(first_entry);
    }
    made.first = tree_.entries.size();
    made.all = static_cast<std::uint32_t>(all.size());
    made.own = static_cast<std::uint32_t>(own.size());
    tree_.entries.insert(tree_.entries.end(), all.begin(), all.end());
    tree_.entries.insert(tree_.entries.end(), own.begin(), own.end());
    tree_.peak_entries = std::max(tree_.peak_entries, tree_.entries.size());
    tree_.nodes[number] = made;
    return keeps_children ? below : as_leaf;
  }

  double split(std::uint32_t children, const Place& place, const Entries& own, std::span<const LitBrick> rest) {
    const std::uint64_t size = 1ULL << 3 * (levels_ - place.level - 1);  // finest bricks of a child
    double cost = LEAST_PRICE * CHILDREN_WORDS;
    for (std::uint32_t child = 0; child < 8; ++child) {
      Entries of_child;
      for (const Entry& entry : own)
        if (const std::uint64_t cells = cells_of_child(entry.cells, child); cells != 0)
          of_child.push_back({.light = entry.light, .cells = cells});
      const std::uint64_t corner = place.corner + child * size;
      const auto end = std::ranges::lower_bound(rest, corner + size, {}, &LitBrick::place);
      cost += node(children + child, {.level = place.level + 1, .corner = corner, .all = place.all}, of_child,
                   {rest.begin(), end});
      rest = {end, rest.end()};
    }
    return cost;
  }

  [[nodiscard]] Entries merged(std::uint32_t children) const {
    Entries all;
    for (std::uint32_t child = 0; child < 8; ++child) {
      const BrickNode& node = tree_.nodes[children + child];
      for (const std::span<const Entry> part : {tree_.all_of(node), tree_.own_of(node)})
        for (const Entry& entry : part)
          all.push_back({.light = entry.light, .cells = cells_of_parent(entry.cells, child)});
    }
    std::ranges::sort(all, {}, &Entry::light);
    Entries entries;
    for (const Entry& entry : all)
      if (!entries.empty() && entries.back().light == entry.light)
        entries.back().cells |= entry.cells;
      else
        entries.push_back(entry);
    return entries;
  }

  [[nodiscard]] BrickNode leaf(const Place& place, const Entries& own) const {
    double weight = std::ldexp(1.0, -3 * static_cast<int>(place.level));
    if (!surfaces_.empty()) {
      const std::uint64_t end = place.corner + (1ULL << 3 * (levels_ - place.level));
      const auto on_surfaces =
          std::ranges::lower_bound(surfaces_, end) - std::ranges::lower_bound(surfaces_, place.corner);
      weight += static_cast<double>(on_surfaces) / static_cast<double>(surfaces_.size());
    }
    std::uint64_t lights = 64 * place.all;
    for (const Entry& entry : own) lights += static_cast<std::uint64_t>(std::popcount(entry.cells));
    return {.walked = weight * static_cast<double>(lights) / 64.0,
            .words = leaf_words(place.all + own.size(), is_plain(own))};
  }

  std::span<const LitBrick> bricks_;
  std::uint32_t levels_;
  std::span<const std::uint64_t> surfaces_;
  BrickTree tree_;
};

/// Prunes with a price for a word.
class Pruning {
 public:
  Pruning(const BrickTree& tree, double price)
      : tree_(tree), price_(price), pruned_{std::vector<bool>(tree.nodes.size())} {}

  Pruned run() {
    static_cast<void>(cost(0));
    mark(0);
    return std::move(pruned_);
  }

 private:
  double cost(std::uint32_t number) {
    const BrickNode& node = tree_.nodes[number];
    const double as_leaf = cost_as_leaf(node, price_);
    if (node.children == 0) {
      pruned_.leaves[number] = true;
      return as_leaf;
    }
    double below = price_ * CHILDREN_WORDS;
    for (std::uint32_t child = 0; child < 8; ++child) below += cost(node.children + child);
    pruned_.leaves[number] = is_better_as_leaf(as_leaf, below);
    return pruned_.leaves[number] ? as_leaf : below;
  }

  void mark(std::uint32_t number) {
    const BrickNode& node = tree_.nodes[number];
    if (pruned_.leaves[number]) {
      pruned_.words += node.words;
      pruned_.walked += node.walked;
      return;
    }
    pruned_.words += 8;
    for (std::uint32_t child = 0; child < 8; ++child) mark(node.children + child);
  }

  const BrickTree& tree_;
  double price_;
  Pruned pruned_;
};

}  // namespace

std::uint64_t leaf_words(std::uint64_t lights, bool plain) {
  if (lights == 0) return 0;  // all such leaves share one
  return 1 + lights * (plain ? 1 : 3);
}

bool is_plain(std::span<const Entry> entries) {
  return std::ranges::all_of(entries, [](const Entry& entry) { return entry.cells == ALL_CELLS; });
}

BrickTree make_tree(std::span<const LitBrick> bricks, std::uint32_t levels, std::span<const std::uint64_t> surfaces) {
  return Making(bricks, levels, surfaces).run();
}

Pruned prune(const BrickTree& tree, std::uint64_t words) {
  Pruned best = Pruning(tree, LEAST_PRICE).run();
  if (best.words <= words) return best;
  double low = std::log(LEAST_PRICE);
  double high = std::log(1e6);
  best = Pruning(tree, std::exp(high)).run();
  for (int i = 0; i < 40 && high - low > 1e-3; ++i) {
    const double middle = 0.5 * (low + high);
    Pruned pruned = Pruning(tree, std::exp(middle)).run();
    if (pruned.words <= words) {
      high = middle;
      best = std::move(pruned);
    } else {
      low = middle;
    }
  }
  return best;
}

}  // namespace lamp::world
