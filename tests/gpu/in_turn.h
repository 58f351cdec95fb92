// Which of many combinations a run tests: all of them take a software device hours, so they take turns.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>

namespace lamp::app {

/// Whether it is the turn of a combination: of one among `of` that follow each other, or of each where the environment
/// has LAMPLIGHT_TEST_ALL.
inline bool has_turn(std::size_t number, std::size_t of) {
  static const bool all = std::getenv("LAMPLIGHT_TEST_ALL") != nullptr;
  return all || number % of == 0;
}

}  // namespace lamp::app
