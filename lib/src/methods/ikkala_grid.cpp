// Hierarchical bitmask implicit grid: along each axis of the world, slices with a bit for each light; a cell's lights
// are those whose bits three slices share. Lights are sorted along a space-filling curve, so that few words of bits
// have any in a slice, and a second layer of bits says which. Based on: Ikkala, Lauttia, Jääskeläinen, Mäkitalo,
// Hierarchical Bitmask Implicit Grids for Efficient Point-in-Volume Queries on the GPU, GRAPP (2024). Promise: memory
// O(N R) for R cells along each axis; right at any point; nothing can overflow; the same walk every run, in the order
// of the curve.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <string>

#include "lamplight/shared/implicit_grid.h"
#include "light_sort.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

using shared::GRID_BLOCK;
using shared::GRID_BLOCK_WORDS;

constexpr std::uint64_t BUDGET = 64U << 20;  // bytes of bits, for cells=0
constexpr std::uint32_t LEAST_CELLS = 8;     // that any number of lights has
constexpr std::uint32_t USUAL_CELLS = 511;   // with what is no number 512 slices: whole work groups of them
constexpr std::uint32_t MOST_CELLS = shared::GRID_MOST_SLICES - 1;
constexpr std::uint64_t MOST_BYTES = 1ULL << 32;  // of bits: places of words have 32 bits, those of all views together
constexpr std::uint32_t KEY_DIGITS = 2;
constexpr std::uint32_t MOST_EXTENT_M = 1'000'000;

struct Sizes {
  std::uint32_t lights;  ///< capacity
  std::uint32_t blocks;  ///< of lights
  std::uint32_t cells;   ///< along each axis
  bool sorted;
  bool fewer;  ///< cells than usual, so that their bits take no more than BUDGET

  /// Words, one for each block, of all slices. Where cells are fewer, room for as many as ever: more lights never have
  /// less of it.
  [[nodiscard]] std::uint64_t block_words() const {
    const std::uint64_t words = 3ULL * (cells + 1) * blocks;
    return fewer ? std::max(words, BUDGET / (GRID_BLOCK_WORDS * 4)) : words;
  }
};

/// Bytes of bits that a cell along each axis more takes.
std::uint64_t bytes_a_cell(const Sizes& s) { return 3ULL * s.blocks * GRID_BLOCK_WORDS * 4; }

/// As many cells along each axis as asked for and as fit. Says so where they are fewer.
std::uint32_t cells_that_fit(Plan& plan, const Problem& problem, const Sizes& s) {
  const std::uint32_t asked = problem.options.integer("cells");
  const std::uint64_t most_bytes = std::min(problem.traits.max_storage_buffer_bytes, MOST_BYTES);
  const std::uint64_t bytes = asked == 0 ? std::min(BUDGET, most_bytes) : most_bytes;
  const std::uint64_t slices = std::max<std::uint64_t>(bytes / bytes_a_cell(s), LEAST_CELLS + 1);
  const std::uint32_t wanted = asked == 0 ? USUAL_CELLS : asked;
  const auto cells = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, slices - 1));
  if (cells < wanted)
    plan.notes.push_back(std::to_string(cells) + " cells along each axis instead of " + std::to_string(wanted) +
                         ": their bits for " + std::to_string(s.lights) + " lights would take over " +
                         std::to_string(bytes >> 20) + " MiB");
  return cells;
}

Sizes sizes_of(Plan& plan, const Problem& problem) {
  Sizes s{.lights = parts::capacity(problem), .sorted = problem.options.word("order") == "curve"};
  s.blocks = parts::divide_up(s.lights, GRID_BLOCK);
  s.cells = cells_that_fit(plan, problem, s);
  s.fewer = s.cells < USUAL_CELLS && problem.options.integer("cells") == 0;
  return s;
}

struct Buffers {
  ResourceId extents, grid, keys, order, ranges, block_words, bits;
};

Buffers add_buffers(Plan& plan, const Sizes& s) {
  Buffers b{};
  b.extents = plan.add({.name = "light extents", .bytes = shared::GRID_EXTENT_WORDS * 4, .zeroed = true});
  b.grid = plan.add({.name = "grid", .bytes = sizeof(shared::ImplicitGrid)});
  b.keys = plan.add({.name = "light keys", .bytes = std::uint64_t{s.lights} * 4});
  b.ranges = plan.add({.name = "slice ranges", .bytes = std::uint64_t{s.lights} * 3 * 4});
  b.block_words = plan.add({.name = "block words", .bytes = s.block_words() * 4});
  b.bits = plan.add({.name = "slice bits", .bytes = s.block_words() * GRID_BLOCK_WORDS * 4});
  b.order = b.keys;  // something to bind
  return b;
}

Pass extents_pass(const Problem& problem, const Buffers& b) {
  return {.name = "light extents",
          .shader = "methods/grid_extents",
          .constants = {parts::cull_threads(problem)},
          .bindings = {{INPUT_FRAME}, {INPUT_SPHERES}, {b.extents, Access::read_write}},
          .extent = {.lights_per_group = GRID_BLOCK}};
}

Pass keys_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  const auto extent_m = static_cast<float>(problem.options.integer("extent_m"));
  return {.name = "grid and keys",
          .shader = "methods/grid_keys",
          .constants = {s.cells, std::bit_cast<std::uint32_t>(extent_m)},
          .bindings = {{INPUT_FRAME}, {INPUT_SPHERES}, {b.extents}, {b.grid, Access::write}, {b.keys, Access::write}},
          .extent = {.lights_per_group = 64}};
}

Pass ranges_pass(const Sizes& s, const Buffers& b) {
  return {.name = "slice ranges",
          .shader = "methods/grid_ranges",
          .constants = {s.cells, s.lights, s.sorted ? 1U : 0U},
          .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {INPUT_SPHERES}, {b.grid}, {b.order}, {b.ranges, Access::write}},
          .extent = {.lights_per_group = 64}};
}

Pass bits_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  return {.name = "slice bits",
          .shader = "methods/grid_bits",
          .constants = {parts::cull_threads(problem), s.cells, s.lights, s.blocks},
          .bindings = {{INPUT_FRAME}, {b.ranges}, {b.block_words, Access::write}, {b.bits, Access::write}},
          .extent = {
              .y = 3, .z = parts::divide_up(s.cells + 1, shared::GRID_GROUP_SLICES), .lights_per_group = GRID_BLOCK}};
}

/// Where a device ends loops: a round for each block and, at most, each word of bits besides those for lights.
std::uint64_t most_walked(const Problem& problem, const Sizes& s) {
  const std::uint64_t rounds = problem.traits.max_loop_rounds;
  const std::uint64_t taken = std::uint64_t{s.blocks} * (GRID_BLOCK_WORDS + 1) + 1;
  return rounds > taken ? rounds - taken : 0;
}

Plan plan_ikkala_grid(const Problem& problem) {
  Plan plan;
  const Sizes sizes = sizes_of(plan, problem);
  const std::uint64_t across = sizes.cells + 1;
  plan.cells = across * across * across;
  plan.any_depth = true;
  plan.ordered = !sizes.sorted;
  Buffers b = add_buffers(plan, sizes);
  plan.passes = {extents_pass(problem, b), keys_pass(problem, sizes, b)};
  if (sizes.sorted)
    b.order = parts::add_light_sort(plan, {.by = b.keys,
                                           .keys = true,
                                           .digits = KEY_DIGITS,
                                           .lights = sizes.lights,
                                           .threads = parts::cull_threads(problem)});
  plan.passes.push_back(ranges_pass(sizes, b));
  plan.passes.push_back(bits_pass(problem, sizes, b));
  plan.lookup = {.name = "implicit_grid",
                 .constants = {sizes.cells, sizes.blocks, sizes.sorted ? 1U : 0U},
                 .bindings = {{INPUT_FRAME}, {b.grid}, {b.block_words}, {b.bits}, {b.order}}};
  if (problem.traits.max_loop_rounds != ~0U) plan.lookup.most_walked = most_walked(problem, sizes);
  return plan;
}

}  // namespace

Method ikkala_grid_method() {
  return {
      .name = "ikkala-grid",
      .title = "Hierarchical bitmask implicit grid: lights at any point",
      .source =
          "Ikkala, Lauttia, Jaaskelainen, Makitalo, Hierarchical Bitmask Implicit Grids for Efficient "
          "Point-in-Volume Queries on the GPU, GRAPP (2024)",
      .summary = "Slices along each axis of the world have a bit for each light; a cell is where three slices meet.",
      .result = "implicit_grid",
      .ordered = false,
      .needs_depth = false,
      .any_depth = true,
      .any_point = true,
      .options = {{.key = "cells",
                   .help = "cells along each axis, 8 and more; 0: 511, and fewer where their bits would take over 64 "
                           "MiB",
                   .fallback = "0",
                   .min = 0,
                   .max = MOST_CELLS},
                  {.key = "extent_m",
                   .help = "the grid reaches no farther from the eye, metres; its border cells go on to infinity. "
                           "0: as far as lights of finite range",
                   .fallback = "0",
                   .min = 0,
                   .max = MOST_EXTENT_M},
                  {.key = "order",
                   .help = "of lights in words of bits, and of walks: along a space-filling curve, or their own",
                   .fallback = "curve",
                   .choices = {"curve", "index"}}},
      .plan = plan_ikkala_grid,
      .check = [](const Problem& problem) -> std::optional<Error> {
        const std::uint32_t cells = problem.options.integer("cells");
        if (cells == 0 || cells >= LEAST_CELLS) return std::nullopt;
        return Error{"option cells", "expected 0, or 8 and more; got " + std::to_string(cells)};
      }};
}

}  // namespace lamp
