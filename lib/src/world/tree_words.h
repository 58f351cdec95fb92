// The words of a tree (shared/world_tree.h): written, read and changed on the host.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "brick_tree.h"
#include "lamplight/shared/world_tree.h"
#include "lamplight/world_tree.h"

namespace lamp::world {

class TreeWords {
 public:
  TreeWords() = default;
  /// `outside`: the lights of points outside of the root.
  TreeWords(const TreeGrid& grid, const BrickTree& tree, const Pruned& pruned, std::span<const std::uint32_t> outside);
  /// Of a tree that is every light everywhere.
  static TreeWords of_every_light(const TreeGrid& grid);

  [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
  void reserve(std::uint64_t words) { words_.reserve(words); }
  void set_lights(std::uint32_t count) { words_[shared::TREE_LIGHTS] = count; }
  /// Calls `found(place of the node's word, level, brick)` for all leaves in bricks that `enter(level, brick)` says yes
  /// of.
  using Enter = std::function<bool(std::uint32_t level, const glm::uvec3& brick)>;
  using Found = std::function<void(std::uint64_t node, std::uint32_t level, const glm::uvec3& brick)>;
  void leaves(const Enter& enter, const Found& found) const;

  [[nodiscard]] std::uint32_t count(std::uint64_t node) const;  ///< lights of a leaf
  [[nodiscard]] std::vector<Entry> entries(std::uint64_t node) const;
  /// A leaf's list, in its place where that is large enough, else at the end. Adds what changed.
  void replace(std::uint64_t node, std::span<const Entry> entries, std::vector<ChangedWords>& changed);
  [[nodiscard]] std::vector<std::uint32_t> lights_at(const Vec3& position, std::uint32_t light_count) const;

 private:
  /// `all`: lights that nodes above it keep.
  void write_node(std::uint64_t node, const BrickTree& tree, const Pruned& pruned, std::uint32_t number,
                  std::span<const Entry> all);
  [[nodiscard]] std::uint32_t append(std::span<const Entry> entries);
  void write_bits(std::uint64_t first, std::span<const Entry> entries);
  void visit(std::uint64_t node, std::uint32_t level, const glm::uvec3& brick, const Enter& enter,
             const Found& found) const;
  [[nodiscard]] std::uint64_t leaf_at(const Vec3& position, std::uint32_t& cell) const;

  std::vector<std::uint32_t> words_;
};

}  // namespace lamp::world
