// World cells: the lights of any point of the world, on screen or off. Lights look for bricks of cells, which are
// larger for lights of larger range; bricks are found by a hash, so that there are no bounds, and only those with
// lights exist. Based on: Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, VMV
// (2003); levels by size: Eitz, Lixu, Hierarchical Spatial Hashing for Real-Time Collision Detection, SMI (2007).
// Promise: work grows with lights and what they reach; lists ascend; what does not fit is counted, and walked the long
// way.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>

#include "../world/mean_bricks.h"
#include "lamplight/shared/world.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

// Of a walk's loops, one in the other, where a device counts them all: of a light, and of each level beyond those whose
// place is kept, which are searched by halving for each of their lights.
constexpr std::uint32_t ROUNDS_A_LIGHT = 8;
constexpr std::uint32_t ROUNDS_A_SEARCH = 3;  // besides those of the halving

using shared::BRICK_CELLS;
using shared::BRICK_SLICES;
using shared::WORLD_PIECE;

constexpr std::uint32_t THREADS = 256;
constexpr std::uint32_t GROUP_BRICKS = 512;       // of a group's lights that look for theirs, about,
constexpr std::uint32_t LISTED_BRICKS = 768;      // and at most, but for those that their own thread tests
constexpr std::uint32_t SCAN_BUCKETS = 4;         // of a thread
constexpr std::uint32_t LIGHT_BUCKETS = 8;        // for each light,
constexpr std::uint32_t LEAST_BUCKETS = 1024;     // but no fewer
constexpr std::uint32_t MOST_BUCKETS = 1U << 20;  // and no more, of 12 bytes each
constexpr std::uint64_t MOST_ENTRIES = 1U << 30;  // the place of a word of bits has 32 bits
constexpr std::uint64_t SMALL_BYTES = 5U << 20;   // room for all that lights can reach, where it takes no more
constexpr std::uint32_t MOST_PERCENT = 1600;
constexpr std::uint64_t BUDGET_BYTES = 64U << 20;     // of entries, for brick=0
constexpr std::uint32_t FINEST_PERCENT = 100;         // for brick=0,
constexpr std::uint32_t FINEST_SLICED_PERCENT = 300;  // where slices have bits,
constexpr std::uint32_t COARSEST_PERCENT = 400;       // and where lights are so many that the budget does not matter
constexpr std::uint64_t MEAN_BRICKS = 24;             // default of the option
constexpr std::uint32_t LEAST_PERCENT = 50;           // of the range: a code tells 6 bricks across apart
static_assert(THREADS + THREADS / 2 <= WORLD_PIECE);  // a group holds a window's entries, and the last short bucket's
static_assert(2 * 100 / LEAST_PERCENT + 2 <= shared::MOST_BRICKS_ACROSS);

/// Of one light, wherever it is.
std::uint64_t most_bricks(double ratio) {
  const auto across = static_cast<std::uint64_t>(std::ceil(2 / ratio)) + 1;
  return across * across * across;
}

/// Halves of a word for an entry's bits, of a brick of so many cells along each axis: a bit for each, or for each
/// slice.
std::uint32_t halves_of(std::uint32_t cells) {
  return cells == BRICK_SLICES ? shared::SLICE_HALVES : shared::CELL_HALVES;
}
std::uint32_t bit_bytes(std::uint32_t cells) { return 2 * halves_of(cells); }
std::uint32_t entry_bytes(std::uint32_t cells) { return 4 + bit_bytes(cells); }
std::uint64_t bit_words(std::uint64_t entries, std::uint32_t cells) { return entries * bit_bytes(cells) / 4; }
std::uint64_t budget(std::uint32_t cells) { return BUDGET_BYTES / entry_bytes(cells); }

struct Sizes {
  float ratio;  ///< a brick's side is this share of a light's range, to twice that
  std::uint32_t buckets;
  std::uint32_t entries;
  std::uint32_t pieces;
  std::uint32_t threads;
  std::uint32_t most_short;  ///< entries of a bucket that one work group puts in order
  std::uint32_t window;      ///< entries; the short buckets that begin in it have a work group
  std::uint32_t cells;       ///< of a brick, along each axis
  std::uint32_t lights;      ///< of a group that finds their bricks, in one turn,
  std::uint32_t turns;       ///< of which it has so many
  std::uint32_t groups;      ///< of that kind
  std::uint32_t found;       ///< what a group may find: it has the room of the bits, until these are made
};

std::uint64_t bricks_anywhere(const Problem& problem, double ratio) {
  return static_cast<std::uint64_t>(parts::capacity(problem) * mean_bricks(ratio));
}

std::uint32_t bucket_count(const Problem& problem) {
  const std::uint64_t wanted = std::bit_ceil(std::uint64_t{parts::capacity(problem)} * LIGHT_BUCKETS);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(wanted, LEAST_BUCKETS, MOST_BUCKETS));
}

/// Along a brick: slices, where so many lights would have more bits of cells than the budget has of slices.
std::uint32_t cells_across(const Problem& problem) {
  if (const std::uint32_t cells = problem.options.integer("cells"); cells != 0) return cells;
  if (problem.options.integer("brick") != 0) return BRICK_CELLS;
  const bool many = bit_words(bricks_anywhere(problem, FINEST_PERCENT / 100.0), BRICK_CELLS) >
                    bit_words(budget(BRICK_SLICES), BRICK_SLICES);
  return many ? BRICK_SLICES : BRICK_CELLS;
}

/// Of the lists that have these entries: of slices an even number each.
std::uint64_t room_of(const Problem& problem, std::uint64_t entries, std::uint32_t cells) {
  return halves_of(cells) % 2 == 0 ? entries : entries + std::min<std::uint64_t>(entries, bucket_count(problem));
}

/// Percent of a light's range: as the option says, or the least for which the entries of lights anywhere keep the
/// budget.
std::uint32_t brick_percent(const Problem& problem, std::uint32_t cells) {
  if (const std::uint32_t percent = problem.options.integer("brick"); percent != 0) return percent;
  std::uint32_t percent = cells == BRICK_SLICES ? FINEST_SLICED_PERCENT : FINEST_PERCENT;
  const auto room = [&] { return room_of(problem, bricks_anywhere(problem, percent / 100.0), cells); };
  while (percent < COARSEST_PERCENT && room() > budget(cells)) ++percent;
  return percent;
}

/// Room for lights anywhere, and for all bricks of all lights where these are few.
std::uint64_t default_entries(const Problem& problem, double ratio, std::uint32_t cells) {
  const std::uint64_t worst = room_of(problem, parts::capacity(problem) * most_bricks(ratio), cells);
  if (worst * entry_bytes(cells) <= SMALL_BYTES) return worst;
  std::uint64_t anywhere = room_of(problem, bricks_anywhere(problem, ratio), cells);
  if (problem.options.integer("brick") == 0) {  // more lights never have fewer bits, though their bricks be larger
    const std::uint64_t finest =
        bricks_anywhere(problem, FINEST_PERCENT / 100.0) * bit_bytes(BRICK_CELLS) / bit_bytes(cells);
    anywhere = std::max(anywhere, std::min(budget(cells), finest));
  }
  return std::min(worst, anywhere);
}

std::uint64_t wanted_entries(const Problem& problem, double ratio, std::uint32_t cells) {
  const std::uint64_t lights = parts::capacity(problem);
  const std::uint64_t mean = problem.options.integer("mean_bricks");
  const std::uint64_t usual = default_entries(problem, ratio, cells);
  return mean < MEAN_BRICKS ? std::min(usual, lights * mean) : usual + lights * (mean - MEAN_BRICKS);
}

void set_find_sizes(const Problem& problem, Sizes& s) {
  const double across = 1 + 1.5 / s.ratio;  // on average: a side is anywhere between the least and twice that
  const auto lights = static_cast<std::uint32_t>(GROUP_BRICKS / (across * across * across));
  s.lights = std::max(1U, std::min(std::bit_floor(lights), s.threads));
  s.turns = parts::divide_up(parts::divide_up(parts::capacity(problem), s.lights),
                             std::max(1U, problem.traits.max_groups[0]));
  s.groups = parts::divide_up(parts::capacity(problem), s.lights * s.turns);
  const bool is_told_apart = s.lights * s.turns <= 1U << shared::FOUND_LIGHT_BITS;
  const std::uint64_t most = is_told_apart ? 1 + s.lights * s.turns * most_bricks(s.ratio) : 1;
  const std::uint64_t room = bit_words(s.entries, s.cells) * 4 / sizeof(shared::WorldFound) / s.groups;
  s.found = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(room, 1, most));
}

/// Bits of cells, and before there are any what groups found.
std::uint64_t bit_buffer_bytes(const Sizes& s) {
  return std::max(bit_words(s.entries, s.cells) * 4, std::uint64_t{s.groups} * s.found * sizeof(shared::WorldFound));
}

Sizes sizes_of(const Problem& problem) {
  const std::uint32_t cells = cells_across(problem);
  Sizes s{.ratio = static_cast<float>(brick_percent(problem, cells)) / 100.0F, .cells = cells};
  s.threads = std::min(THREADS, std::bit_floor(problem.traits.max_group_invocations));
  s.most_short = s.threads / 2;
  s.window = s.threads;
  s.buckets = bucket_count(problem);
  s.entries = static_cast<std::uint32_t>(std::min({wanted_entries(problem, s.ratio, cells), MOST_ENTRIES,
                                                   problem.traits.max_storage_buffer_bytes / bit_bytes(cells)}));
  set_find_sizes(problem, s);
  s.pieces = parts::divide_up(s.entries, s.most_short);  // all but a bucket's last are longer still
  return s;
}

struct Buffers {
  ResourceId totals, levels, counts, buckets, windows, pieces, entries, bits;
};

Buffers add_buffers(Plan& plan, const Sizes& s) {
  Buffers b{};
  b.totals = plan.add({.name = "totals",
                       .bytes = sizeof(shared::WorldTotals),
                       .memory = BufferMemory::counts,
                       .zeroed = true,
                       .indirect = true});
  b.levels = plan.add({.name = "levels", .bytes = 4, .zeroed = true});
  plan.counters = b.totals;
  b.counts = plan.add({.name = "bucket counts", .bytes = std::uint64_t{s.buckets} * 4, .zeroed = true});
  b.buckets = plan.add({.name = "buckets", .bytes = std::uint64_t{s.buckets} * sizeof(shared::WorldBucket)});
  b.windows = plan.add({.name = "windows", .bytes = (std::uint64_t{s.entries} / s.window + 1) * 4});
  b.pieces = plan.add({.name = "pieces", .bytes = std::uint64_t{s.pieces} * sizeof(shared::WorldPiece)});
  b.entries = plan.add({.name = "bucket entries", .bytes = std::uint64_t{s.entries} * 4});
  b.bits = plan.add({.name = "cell bits", .bytes = bit_buffer_bytes(s)});
  return b;
}

/// A pass whose groups find the bricks of some lights each.
Pass find_pass(const Sizes& s, const Buffers& b) {
  return {.constants = {s.threads, s.lights, std::bit_cast<std::uint32_t>(s.ratio), s.buckets, LISTED_BRICKS, s.turns,
                        s.found},
          .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {INPUT_SPHERES}, {b.counts, Access::read_write}},
          .extent = {.lights_per_group = s.lights * s.turns}};
}

Pass count_pass(const Sizes& s, const Buffers& b) {
  Pass pass = find_pass(s, b);
  pass.name = "count bricks";
  pass.shader = "methods/world_count";
  pass.bindings.insert(pass.bindings.end(),
                       {{b.levels, Access::read_write}, {b.bits, Access::write}, {b.totals, Access::read_write}});
  return pass;
}

Pass fill_pass(const Sizes& s, const Buffers& b) {
  Pass pass = find_pass(s, b);
  pass.name = "fill buckets";
  pass.shader = "methods/world_fill";
  pass.constants.insert(pass.constants.end(), {s.entries, s.window});
  pass.bindings.insert(pass.bindings.end(),
                       {{b.buckets}, {b.entries, Access::write}, {b.totals, Access::read_write}, {b.bits}});
  return pass;
}

std::uint32_t brick_cells(const Sizes& s) { return s.cells * s.cells * s.cells; }

Pass scan_pass(const Sizes& s, const Buffers& b) {
  return {.name = "scan buckets",
          .shader = "methods/world_scan",
          .constants = {s.threads, s.entries, s.most_short, s.window, halves_of(s.cells), brick_cells(s)},
          .bindings = {{b.counts},
                       {b.totals, Access::read_write},
                       {b.buckets, Access::write},
                       {b.pieces, Access::write},
                       {b.windows, Access::write}},
          .extent = {.x = s.buckets / (s.threads * SCAN_BUCKETS)}};
}

Pass order_pass(const Sizes& s, const Buffers& b) {
  return {.name = "order buckets",
          .shader = "methods/world_order",
          .constants = {std::bit_cast<std::uint32_t>(s.ratio), s.buckets, s.entries, s.most_short, s.threads, s.window,
                        halves_of(s.cells)},
          .bindings = {{INPUT_FRAME},
                       {INPUT_LIGHTS},
                       {INPUT_SPHERES},
                       {b.totals},
                       {b.buckets},
                       {b.windows},
                       {b.entries, Access::read_write},
                       {b.bits, Access::write},
                       {b.pieces}},
          .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::WorldTotals, order_x)}};
}

Extent of_pieces(const Buffers& b) {
  return {.indirect = b.totals, .indirect_offset = offsetof(shared::WorldTotals, pieces_x)};
}

Pass merge_pass(const Sizes& s, const Buffers& b) {
  return {.name = "merge long buckets",
          .shader = "methods/world_merge",
          .constants = {halves_of(s.cells), s.threads},
          .bindings = {{b.totals}, {b.buckets}, {b.pieces}, {b.bits}, {b.entries, Access::write}},
          .extent = of_pieces(b)};
}

Pass bits_pass(const Sizes& s, const Buffers& b) {
  return {.name = "bits of long buckets",
          .shader = "methods/world_bits",
          .constants = {std::bit_cast<std::uint32_t>(s.ratio), halves_of(s.cells), s.threads},
          .bindings = {{INPUT_FRAME},
                       {INPUT_LIGHTS},
                       {INPUT_SPHERES},
                       {b.totals},
                       {b.buckets},
                       {b.pieces},
                       {b.entries},
                       {b.bits, Access::write}},
          .extent = of_pieces(b)};
}

/// How many lights a walk can name where a device ends loops.
void note_rounds(const Problem& problem, Plan& plan) {
  const std::uint32_t rounds = problem.traits.max_loop_rounds;
  if (rounds == ~0U) return;
  plan.lookup.most_walked = rounds / ROUNDS_A_LIGHT;
  const auto search = static_cast<std::uint32_t>(std::bit_width(problem.light_capacity)) + ROUNDS_A_SEARCH;
  const std::uint32_t of_all_levels =
      rounds / (ROUNDS_A_LIGHT + (shared::WORLD_LEVELS + 1 - shared::WORLD_STREAMS) * search);
  if (problem.light_capacity <= of_all_levels) return;
  plan.notes.push_back("a point that walks more than " + std::to_string(of_all_levels) +
                       " lights of more than four levels, whose ranges differ 16 times and more, can lose some: the "
                       "device ends a thread's loops after " +
                       std::to_string(rounds) + " rounds");
}

Plan plan_world_cells(const Problem& problem) {
  const Sizes sizes = sizes_of(problem);
  Plan plan;
  plan.cells = std::uint64_t{sizes.buckets} * brick_cells(sizes);
  plan.any_depth = true;
  const Buffers b = add_buffers(plan, sizes);
  plan.capacities = {parts::shared_list("mean_bricks", sizes.entries, parts::capacity(problem))};
  plan.passes = {count_pass(sizes, b), scan_pass(sizes, b),  fill_pass(sizes, b),
                 order_pass(sizes, b), merge_pass(sizes, b), bits_pass(sizes, b)};
  plan.lookup = {.name = "world_cells",
                 .constants = {sizes.buckets, sizes.cells},
                 .bindings = {{INPUT_FRAME}, {b.buckets}, {b.entries}, {b.bits}, {b.levels}}};
  note_rounds(problem, plan);
  return plan;
}

std::optional<Error> check_world_cells(const Problem& problem) {
  const std::uint32_t percent = problem.options.integer("brick");
  if (percent == 0 || percent >= LEAST_PERCENT) return std::nullopt;
  return Error{"option brick", "expected 0, or " + std::to_string(LEAST_PERCENT) +
                                   " and more: a light has at most 6 bricks across; got " + std::to_string(percent)};
}

}  // namespace

Method world_cells_method() {
  return {
      .name = "world-cells",
      .title = "World cells: lights at any point",
      .source = "This project, docs/methods/world-cells.md",
      .summary = "Lights are listed in cells of the world, larger ones for larger lights; no camera, no bounds.",
      .result = "world_cells",
      .needs_depth = false,
      .any_depth = true,
      .any_point = true,
      .options = {{.key = "brick",
                   .help = "least side of a brick of cells, percent of a light's range, 50 and more; 0: 100, 300 with "
                           "cells=16, and more where the lists of all lights would take over 64 MiB",
                   .fallback = "0",
                   .min = 0,
                   .max = MOST_PERCENT},
                  {.key = "cells",
                   .help =
                       "along a brick: 4, with a bit for each, or 16, with one for each slice, which takes less room "
                       "and longer to look up; 0: 4, or with brick=0 16 from some 240 000 lights on",
                   .fallback = "0",
                   .choices = {"0", "4", "16"}},
                  {.key = "mean_bricks",
                   .help = "bricks a light, on average, that there is room for; from 24 on, as many as lights "
                           "anywhere reach and what is beyond 24, and all where these are few",
                   .fallback = "24",
                   .min = 1,
                   .max = 256}},
      .plan = plan_world_cells,
      .check = check_world_cells};
}

}  // namespace lamp
