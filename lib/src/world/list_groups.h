// Lists of lights in groups: the lights of neighbouring lists once, ascending, and for each list a bit for each of
// them. Promise: a list that is already there is not stored again.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lamplight/shared/triangle_lists.h"

namespace lamp::world {

/// Of lists, with what comes before them. A name has 31 bits; the last of all is TRIANGLE_UNLIT's.
inline constexpr std::size_t MOST_LIST_WORDS =
    ((std::size_t{1} << (31 - shared::TRIANGLE_ROW_BITS)) - 1) * shared::TRIANGLE_GROUP_UNIT;

class ListGroups {
 public:
  /// The list that a word stands for; lists of neighbours come one after the other.
  void add(std::size_t word, std::vector<std::uint32_t> list);
  /// Closes the last group. False: with so many words before them, lists take more than `most_words`.
  [[nodiscard]] bool finish(std::size_t words_before, std::size_t most_words);
  /// Of closed groups.
  [[nodiscard]] std::size_t words() const { return words_.size(); }

  /// Writes the lists behind `words`, and into its words what names them.
  void store(std::vector<std::uint32_t>& words) const;
  [[nodiscard]] std::uint64_t groups() const { return groups_; }
  [[nodiscard]] std::uint64_t lists() const { return lists_; }

 private:
  struct Place {
    std::size_t word = 0;
    std::uint32_t name = 0;  ///< of the list, as if groups began at word 0
  };
  struct Waiting {
    std::size_t word = 0;
    std::size_t row = 0;
  };
  void close();
  [[nodiscard]] bool fits(const std::vector<std::uint32_t>& list, std::vector<std::uint32_t>& together) const;
  [[nodiscard]] bool is(std::uint32_t name, std::span<const std::uint32_t> list) const;

  std::vector<std::uint32_t> words_;  ///< closed groups
  std::vector<Place> places_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> names_;  ///< by a hash of the list
  std::vector<std::uint32_t> together_;                          ///< lights of the open group
  std::vector<std::vector<std::uint32_t>> rows_;                 ///< and its lists
  std::vector<Waiting> waiting_;
  std::uint64_t groups_ = 0;
  std::uint64_t lists_ = 0;
};

/// Appends the list of a name to `to`; the groups begin at `words`.
void read_list(std::span<const std::uint32_t> words, std::uint32_t name, std::vector<std::uint32_t>& to);

}  // namespace lamp::world
