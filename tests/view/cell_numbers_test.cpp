// Numbers stand in their cells, where these are widest.
// SPDX-License-Identifier: Apache-2.0
#include "view/cell_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/shaders/sky_cell.h"

namespace lamp::app {
namespace {

/// A letter a pixel, ' ' is sky.
std::vector<Visit> visits_of(const std::vector<std::string>& rows) {
  std::vector<Visit> visits;
  for (const std::string& row : rows)
    for (const char letter : row)
      visits.push_back({.cell = letter == ' ' ? gpu::SKY_CELL : static_cast<std::uint32_t>(letter)});
  return visits;
}

CellPlaces places_of(const std::vector<std::string>& rows) {
  const auto width = static_cast<std::uint32_t>(rows.front().size());
  return cell_places(visits_of(rows), {.width = width, .first = 0, .end = width});
}

TEST(CellNumbers, StandInTheMiddleOfTiles) {
  const CellPlaces found = places_of({"aaaabb", "aaaabb", "aaaabb", "aaaabb"});
  EXPECT_EQ(found.cells, 2);
  const std::vector<CellPlace> expected{{'a', {2.0F, 2.0F}, {4, 4}}, {'b', {5.0F, 2.0F}, {2, 4}}};
  EXPECT_EQ(found.places, expected);
}

TEST(CellNumbers, StandWhereTheCellIsWidest) {
  const CellPlaces found = places_of({"abbbbbbb", "aabbbbbb", "aaaaaaab", "aaaaaaab", "aaaaaaab", "aab  bbb"});
  const auto a = std::ranges::find(found.places, 'a', &CellPlace::cell);
  EXPECT_EQ(*a, (CellPlace{'a', {3.5F, 3.5F}, {7, 3}}));
}

/// A ring's middle is not its own.
TEST(CellNumbers, StandOnNoOtherCell) {
  const CellPlaces found = places_of({"rrrrrrr", "rrrrrrr", "rrhhhrr", "rrhhhrr", "rrhhhrr", "rrrrrrr", "rrrrrrr"});
  EXPECT_EQ(found.places[0].cell, 'r');
  EXPECT_EQ(glm::min(found.places[0].room.x, found.places[0].room.y), 2);
  EXPECT_EQ(found.places[1], (CellPlace{'h', {3.5F, 3.5F}, {3, 3}}));
}

TEST(CellNumbers, BelongToTheirColumns) {
  const std::vector<Visit> visits = visits_of({"aaaaaa", "aaaaaa"});
  EXPECT_EQ(cell_places(visits, {.width = 6, .first = 2, .end = 6}).places.front(),
            (CellPlace{'a', {4.0F, 1.0F}, {4, 2}}));
  EXPECT_TRUE(cell_places(visits, {.width = 6, .first = 6, .end = 6}).places.empty());
  EXPECT_EQ(places_of({"  ", "  "}).cells, 0);
}

/// The largest are kept, and what is left out is said.
TEST(CellNumbers, AreBounded) {
  std::vector<Visit> visits;
  for (std::uint32_t i = 0; i < 3 * MOST_NUMBERS; ++i) visits.push_back({.cell = i < 9 ? 1 : i});
  const CellPlaces found = cell_places(visits, {.width = 3 * MOST_NUMBERS, .first = 0, .end = 3 * MOST_NUMBERS});
  EXPECT_EQ(found.cells, 3 * MOST_NUMBERS - 8);
  EXPECT_EQ(found.places.size(), MOST_NUMBERS);
  EXPECT_EQ(found.places.front().cell, 1);
  EXPECT_EQ(words_of_numbers(3, 3), "");
  EXPECT_EQ(words_of_numbers(3, 2), "cells that are too small for their number have none");
  EXPECT_EQ(words_of_numbers(30, 0), "they are too small for their numbers");
  EXPECT_EQ(words_of_numbers(found.cells, MOST_NUMBERS), "the numbers of the 4096 largest are shown");
}

}  // namespace
}  // namespace lamp::app
