// Writes and reads the words.
// SPDX-License-Identifier: Apache-2.0
#include "tree_words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>

namespace lamp::world {
namespace {

using namespace shared;

constexpr std::uint32_t BLOCK = 32;               // lights whose bits lie together
constexpr std::uint64_t NO_LIGHTS = TREE_HEADER;  // the place of an empty leaf's count

std::uint32_t node_of(std::uint32_t kind, std::uint64_t place) {
  return kind << TREE_KIND_BIT | static_cast<std::uint32_t>(place);
}
std::uint32_t kind_of(std::uint32_t node) { return node >> TREE_KIND_BIT; }
std::uint64_t place_of(std::uint32_t node) { return node & TREE_PLACE; }

std::vector<std::uint32_t> header(const TreeGrid& grid) {
  std::vector<std::uint32_t> words(TREE_HEADER + 1, 0);  // and the count of a leaf without lights
  words[TREE_LOW_X] = std::bit_cast<std::uint32_t>(static_cast<float>(grid.low.x));
  words[TREE_LOW_Y] = std::bit_cast<std::uint32_t>(static_cast<float>(grid.low.y));
  words[TREE_LOW_Z] = std::bit_cast<std::uint32_t>(static_cast<float>(grid.low.z));
  words[TREE_SCALE] = std::bit_cast<std::uint32_t>(static_cast<float>(1.0 / grid.cell_m));
  words[TREE_LEVELS] = grid.levels;
  words[TREE_OUTSIDE] = node_of(TREE_PLAIN, NO_LIGHTS);
  return words;
}

std::vector<Entry> both(std::span<const Entry> some, std::span<const Entry> others) {
  std::vector<Entry> entries;
  entries.reserve(some.size() + others.size());
  std::ranges::merge(some, others, std::back_inserter(entries), {}, &Entry::light, &Entry::light);
  return entries;
}

}  // namespace

TreeWords TreeWords::of_every_light(const TreeGrid& grid) {
  TreeWords all;
  all.words_ = header(grid);
  all.words_[TREE_ROOT] = all.words_[TREE_OUTSIDE] = node_of(TREE_ALL, 0);
  return all;
}

TreeWords::TreeWords(const TreeGrid& grid, const BrickTree& tree, const Pruned& pruned,
                     std::span<const std::uint32_t> outside)
    : words_(header(grid)) {
  words_.reserve(words_.size() + pruned.words + outside.size() + 1);
  std::vector<Entry> entries;
  for (const std::uint32_t light : outside) entries.push_back({.light = light, .cells = ALL_CELLS});
  words_[TREE_OUTSIDE] = append(entries);
  write_node(TREE_ROOT, tree, pruned, 0, {});
}

void TreeWords::write_node(std::uint64_t node, const BrickTree& tree, const Pruned& pruned, std::uint32_t number,
                           std::span<const Entry> all) {
  const BrickNode& from = tree.nodes[number];
  const std::vector<Entry> all_here = both(all, tree.all_of(from));
  if (pruned.leaves[number]) {
    words_[node] = append(both(all_here, tree.own_of(from)));
    return;
  }
  const std::uint64_t children = words_.size();
  words_.resize(children + 8);
  words_[node] = node_of(TREE_INNER, children);
  for (std::uint32_t child = 0; child < 8; ++child)
    write_node(children + child, tree, pruned, from.children + child, all_here);
}

std::uint32_t TreeWords::append(std::span<const Entry> entries) {
  if (entries.empty()) return node_of(TREE_PLAIN, NO_LIGHTS);
  const std::uint64_t place = words_.size();
  const bool plain = is_plain(entries);
  words_.push_back(static_cast<std::uint32_t>(entries.size()));
  for (const Entry& entry : entries) words_.push_back(entry.light);
  if (plain) return node_of(TREE_PLAIN, place);
  words_.resize(words_.size() + 2 * entries.size());
  write_bits(place + 1 + entries.size(), entries);
  return node_of(TREE_CELLS, place);
}

void TreeWords::write_bits(std::uint64_t first, std::span<const Entry> entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t block = i / BLOCK * BLOCK;
    const std::uint64_t width = std::min<std::uint64_t>(entries.size() - block, BLOCK);
    for (std::uint64_t left = entries[i].cells; left != 0; left &= left - 1) {
      const std::uint64_t bit = static_cast<std::uint64_t>(std::countr_zero(left)) * width + (i - block);
      words_[first + 2 * block + bit / 32] |= 1U << bit % 32;
    }
  }
}

void TreeWords::leaves(const Enter& enter, const Found& found) const {
  visit(TREE_ROOT, 0, glm::uvec3(0), enter, found);
}

void TreeWords::visit(std::uint64_t node, std::uint32_t level, const glm::uvec3& brick, const Enter& enter,
                      const Found& found) const {
  if (!enter(level, brick)) return;
  if (kind_of(words_[node]) != TREE_INNER) {
    found(node, level, brick);
    return;
  }
  for (std::uint32_t child = 0; child < 8; ++child)
    visit(place_of(words_[node]) + child, level + 1, 2U * brick + glm::uvec3(child & 1U, child >> 1U & 1U, child >> 2U),
          enter, found);
}

std::uint32_t TreeWords::count(std::uint64_t node) const { return words_[place_of(words_[node])]; }

std::vector<Entry> TreeWords::entries(std::uint64_t node) const {
  const std::uint64_t place = place_of(words_[node]);
  std::vector<Entry> entries(words_[place]);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i] = {.light = words_[place + 1 + i], .cells = ALL_CELLS};
    if (kind_of(words_[node]) != TREE_CELLS) continue;
    entries[i].cells = 0;
    const std::size_t block = i / BLOCK * BLOCK;
    const std::uint64_t width = std::min<std::uint64_t>(entries.size() - block, BLOCK);
    for (std::uint64_t cell = 0; cell < 64; ++cell) {
      const std::uint64_t bit = cell * width + (i - block);
      const std::uint32_t word = words_[place + 1 + entries.size() + 2 * block + bit / 32];
      entries[i].cells |= std::uint64_t{word >> bit % 32 & 1U} << cell;
    }
  }
  return entries;
}

void TreeWords::replace(std::uint64_t node, std::span<const Entry> entries, std::vector<ChangedWords>& changed) {
  const std::uint64_t old = place_of(words_[node]);
  const std::uint64_t old_words = leaf_words(words_[old], kind_of(words_[node]) != TREE_CELLS);
  const std::uint64_t new_words = leaf_words(entries.size(), is_plain(entries));
  const std::uint64_t end = words_.size();
  words_[node] = append(entries);
  changed.push_back({.first = node, .count = 1});
  if (new_words == 0) return;
  if (new_words > old_words) {
    changed.push_back({.first = end, .count = new_words});
    return;
  }
  std::copy(words_.begin() + static_cast<std::ptrdiff_t>(end), words_.end(),
            words_.begin() + static_cast<std::ptrdiff_t>(old));
  words_.resize(end);
  words_[node] = node_of(kind_of(words_[node]), old);
  changed.push_back({.first = old, .count = new_words});
}

std::uint64_t TreeWords::leaf_at(const Vec3& position, std::uint32_t& cell) const {
  const float scale = std::bit_cast<float>(words_[TREE_SCALE]);
  const glm::vec3 low(std::bit_cast<float>(words_[TREE_LOW_X]), std::bit_cast<float>(words_[TREE_LOW_Y]),
                      std::bit_cast<float>(words_[TREE_LOW_Z]));
  const glm::vec3 at = glm::floor(glm::vec3(position) * scale - low);
  const float size = std::ldexp(4.0F, static_cast<int>(words_[TREE_LEVELS]));
  cell = 0;
  const bool lies = at.x >= 0.0F && at.y >= 0.0F && at.z >= 0.0F && at.x < size && at.y < size && at.z < size;
  if (!lies) return TREE_OUTSIDE;
  const glm::uvec3 finest(at);
  std::uint64_t node = TREE_ROOT;
  std::uint32_t shift = words_[TREE_LEVELS];
  for (; kind_of(words_[node]) == TREE_INNER; --shift) {
    const glm::uvec3 child = finest >> (shift + 1U) & 1U;
    node = place_of(words_[node]) + child.x + 2U * child.y + 4U * child.z;
  }
  const glm::uvec3 inside = finest >> shift & 3U;
  cell = inside.x + 4U * (inside.y + 4U * inside.z);
  return node;
}

std::vector<std::uint32_t> TreeWords::lights_at(const Vec3& position, std::uint32_t light_count) const {
  std::uint32_t cell = 0;
  const std::uint64_t node = leaf_at(position, cell);
  std::vector<std::uint32_t> lights;
  if (kind_of(words_[node]) == TREE_ALL) {
    lights.resize(light_count);
    std::iota(lights.begin(), lights.end(), 0U);
    return lights;
  }
  for (const Entry& entry : entries(node))
    if ((entry.cells >> cell & 1U) != 0) lights.push_back(entry.light);
  return lights;
}

}  // namespace lamp::world
