// A list joins the open group where that takes less memory than a group of its own.
// SPDX-License-Identifier: Apache-2.0
#include "list_groups.h"

#include <algorithm>
#include <iterator>

#include "lamplight/shared/triangle_lists.h"

namespace lamp::world {
namespace {

using shared::TRIANGLE_GROUP_UNIT;
using shared::TRIANGLE_ROW_BITS;
using shared::TRIANGLE_ROWS;
using shared::TRIANGLE_UNLIT;

std::size_t whole_units(std::size_t words) {
  return (words + TRIANGLE_GROUP_UNIT - 1) / TRIANGLE_GROUP_UNIT * TRIANGLE_GROUP_UNIT;
}

std::size_t row_words(std::size_t lights) { return (lights + 31) / 32; }

std::size_t group_words(std::size_t lights, std::size_t rows) { return 1 + lights + rows * row_words(lights); }

// Based on: Fowler, Noll, Vo, FNV-1a.
std::uint64_t hash_of(std::span<const std::uint32_t> list) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const std::uint32_t light : list) hash = (hash ^ light) * 0x100000001B3ULL;
  return hash;
}

}  // namespace

void read_list(std::span<const std::uint32_t> words, std::uint32_t name, std::vector<std::uint32_t>& to) {
  const std::size_t group = std::size_t{name >> TRIANGLE_ROW_BITS} * TRIANGLE_GROUP_UNIT;
  const std::size_t lights = words[group];
  const auto of_group = words.subspan(group + 1, lights);
  const auto bits = words.subspan(group + 1 + lights + (name & (TRIANGLE_ROWS - 1)) * row_words(lights));
  for (std::size_t i = 0; i < lights; ++i)
    if ((bits[i / 32] >> i % 32 & 1U) != 0) to.push_back(of_group[i]);
}

bool ListGroups::is(std::uint32_t name, std::span<const std::uint32_t> list) const {
  std::vector<std::uint32_t> read;
  read_list(words_, name, read);
  return std::ranges::equal(read, list);
}

bool ListGroups::fits(const std::vector<std::uint32_t>& list, std::vector<std::uint32_t>& together) const {
  if (rows_.empty()) return false;
  std::ranges::set_union(together_, list, std::back_inserter(together));
  return rows_.size() < TRIANGLE_ROWS && group_words(together.size(), rows_.size() + 1) <=
                                             group_words(together_.size(), rows_.size()) + group_words(list.size(), 1);
}

void ListGroups::add(std::size_t word, std::vector<std::uint32_t> list) {
  if (list.empty()) {
    places_.push_back({word, TRIANGLE_UNLIT});
    return;
  }
  if (const auto row = std::ranges::find(rows_, list); row != rows_.end()) {
    waiting_.push_back({word, static_cast<std::size_t>(row - rows_.begin())});
    return;
  }
  const auto [first, last] = names_.equal_range(hash_of(list));
  for (auto known = first; known != last; ++known)
    if (is(known->second, list)) return places_.push_back({word, known->second});
  std::vector<std::uint32_t> together;
  if (fits(list, together)) {
    together_ = std::move(together);
  } else {
    close();
    together_ = list;
  }
  rows_.push_back(std::move(list));
  waiting_.push_back({word, rows_.size() - 1});
}

void ListGroups::close() {
  if (rows_.empty()) return;
  words_.resize(whole_units(words_.size()));
  const auto group = static_cast<std::uint32_t>(words_.size() / TRIANGLE_GROUP_UNIT);
  words_.push_back(static_cast<std::uint32_t>(together_.size()));
  words_.insert(words_.end(), together_.begin(), together_.end());
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::size_t bits = words_.size();
    words_.resize(bits + row_words(together_.size()));
    for (const std::uint32_t light : rows_[row]) {
      const auto bit = static_cast<std::size_t>(std::ranges::lower_bound(together_, light) - together_.begin());
      words_[bits + bit / 32] |= 1U << bit % 32;
    }
    names_.emplace(hash_of(rows_[row]), (group << TRIANGLE_ROW_BITS) + static_cast<std::uint32_t>(row));
  }
  for (const Waiting& waiting : waiting_)
    places_.push_back({waiting.word, (group << TRIANGLE_ROW_BITS) + static_cast<std::uint32_t>(waiting.row)});
  ++groups_;
  lists_ += rows_.size();
  rows_.clear();
  waiting_.clear();
  together_.clear();
}

bool ListGroups::finish(std::size_t words_before, std::size_t most_words) {
  close();
  return whole_units(words_before) + words_.size() <= most_words;
}

void ListGroups::store(std::vector<std::uint32_t>& words) const {
  words.resize(whole_units(words.size()));
  const auto first = static_cast<std::uint32_t>(words.size() / TRIANGLE_GROUP_UNIT) << TRIANGLE_ROW_BITS;
  for (const Place& place : places_)
    words[place.word] = place.name == TRIANGLE_UNLIT ? TRIANGLE_UNLIT : place.name + first;
  words.insert(words.end(), words_.begin(), words_.end());
}

}  // namespace lamp::world
