// Methods whose lists have a known fault: for the tests of the checks.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

#include "lamplight/method.h"

namespace lamp::app {

/// What a faulty list does: the host writes it, tile_lists walks it.
enum class Fault : std::uint32_t {
  none,
  descending,
  duplicate,
  one_left_out,
  descending_and_one_left_out,
  descending_duplicate_and_one_left_out,
  swap,
  endless,  ///< all lights, then the last again and again: longer than a device that ends loops can walk
};
inline constexpr std::size_t ENDLESS = 70'000;
inline constexpr std::uint32_t LEFT_OUT = 0;  ///< at the eye: reaches every pixel nearer than its range

template <Fault FAULT>
void write_list(const HostContext& context) {
  std::vector<std::uint32_t> list(context.lights.size());
  std::iota(list.begin(), list.end(), 0U);
  constexpr bool descends = FAULT == Fault::descending || FAULT == Fault::descending_and_one_left_out ||
                            FAULT == Fault::descending_duplicate_and_one_left_out;
  constexpr bool lacks_one = FAULT == Fault::one_left_out || FAULT == Fault::descending_and_one_left_out ||
                             FAULT == Fault::descending_duplicate_and_one_left_out;
  if constexpr (lacks_one) std::erase(list, LEFT_OUT);
  if constexpr (descends) std::ranges::reverse(list);
  if constexpr (FAULT == Fault::descending_duplicate_and_one_left_out) list.push_back(LEFT_OUT + 1);
  if constexpr (FAULT == Fault::endless) list.resize(ENDLESS, list.back());
  if constexpr (FAULT == Fault::duplicate) list.insert(list.begin(), list.front());
  if constexpr (FAULT == Fault::swap) std::swap(list[1], list[2]);
  list.insert(list.begin(), static_cast<std::uint32_t>(list.size()));
  std::memcpy(context.buffers[0].data(), list.data(), list.size() * sizeof(list[0]));
}

/// A method with one tile over the whole picture.
template <Fault FAULT>
Method faulty_method() {
  return {.name = "faulty", .result = "tile_lists", .plan = [](const Problem& problem) {
            constexpr std::uint32_t TILE_PX = 32;
            const std::uint32_t capacity = std::max<std::uint32_t>(2 * problem.light_capacity, ENDLESS);
            Plan plan;
            const ResourceId lists =
                plan.add({.name = "lists", .bytes = 4 * std::uint64_t{capacity} + 4, .memory = BufferMemory::upload});
            plan.passes = {{.name = "write the list",
                            .kind = PassKind::host,
                            .bindings = {{lists, Access::write}},
                            .host = write_list<FAULT>}};
            plan.lookup = {.name = "tile_lists",
                           .constants = {TILE_PX, capacity, /*ranges*/ 1},
                           .bindings = {{INPUT_FRAME}, {lists}, {lists}}};
            return plan;
          }};
}

}  // namespace lamp::app
