// Which lights of a piece reach which rows of its cell: a bit matrix in shared memory. A first look at depths drops most
// pairs; those that stay are gathered, so that the exact tests run with all threads of a subgroup.
// Needs: TILE_PX, CELL_TILES, ROWS, MARK_WORDS, PAIRS; `frame`, `lights`, `spheres`; s_lights; PRUNED or not.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_MARKS
#define LAMP_METHODS_LAMPLIGHT_MARKS
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/light_bounds.glsl"
#include "common/sphere_rectangle.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "common/subgroup_work.glsl"
#include "methods/lamplight_rows.glsl"

shared uint s_bits[MARK_WORDS];  // PIECE_WORDS for each of ROWS
shared LightBounds s_spheres[PIECE];
shared uint s_pairs[PAIRS];
shared uint s_pair_count;

uint bit_word(uint row, uint word) { return row * PIECE_WORDS + word; }

// By all threads of the group together, before a barrier.
void clear_marks() {
  for (uint i = gl_LocalInvocationIndex; i < MARK_WORDS; i += gl_WorkGroupSize.x) s_bits[i] = 0u;
  if (gl_LocalInvocationIndex == 0u) s_pair_count = 0u;
}

// A light of the piece and a row, in 32 bits.
struct Pair {
  uint entry;
  uint row;
  bool spot;
};
const uint PAIR_ENTRY_BITS = 16u;
const uint PAIR_OF_SPOT = 0x80000000u;
uint packed_pair(uint entry, uint row, uint spot) { return entry | row << PAIR_ENTRY_BITS | spot; }
Pair pair_of(uint packed) {
  return Pair(packed & (1u << PAIR_ENTRY_BITS) - 1u, (packed & ~PAIR_OF_SPOT) >> PAIR_ENTRY_BITS,
              (packed & PAIR_OF_SPOT) != 0u);
}

bool reaches_row(Pair pair) {
  const LightBounds sphere = s_spheres[pair.entry];
  const TileRanges ranges = ranges_of_row(pair.row, sphere);
  const uint parts = parts_near(sphere, ranges);
  TileSides sides;
  sides.x_edges = s_x_edges[pair.row];
  sides.y_edges = s_y_edges[pair.row];
  if (!sphere_touches_runs(sphere, sides, ranges, parts)) return false;
  return !pair.spot ||
         spot_touches_tile(frame, lights[s_lights[pair.entry]], sides, ranges.z_near[0], ranges.z_far[0], parts);
}

#ifdef PRUNED
#include "methods/lamplight_prune.glsl"
#endif

// The part of a light's rectangle that lies in the rows: first column and line, width, height.
uvec4 rectangle_in_rows(LightBounds sphere, Cell cell) {
  uvec4 tiles;
  tiles_of_sphere(frame, sphere, TILE_PX, tiles);
  const uvec2 first = tiles.xy;
  const uvec2 last = tiles.zw;
  const uvec2 begin = cell.first_tile + uvec2(0u, first_line(cell));
  const uvec2 end = begin + uvec2(CELL_TILES, ROWS / CELL_TILES);
  if (any(greaterThanEqual(first, end)) || any(lessThan(last, begin))) return uvec4(0u);
  const uvec2 low = max(first, begin) - begin;
  return uvec4(low, min(last, end - 1u) - begin + 1u - low);
}

// For a subgroup together.
void gather_pair(uint pair, bool any_pair) {
  const uvec4 those = subgroupBallot(any_pair);
  uint place = 0u;
  if (subgroupElect()) place = atomicAdd(s_pair_count, subgroupBallotBitCount(those));
  place = subgroupBroadcastFirst(place) + subgroupBallotExclusiveBitCount(those);
  if (any_pair) s_pairs[place] = pair;
}

bool meets_row(LightBounds sphere, uint row) { return sphere_meets_mask(sphere, ranges_of_row(row, sphere)); }

// Some entries by one subgroup, a thread each: their tiles are spread over all of its threads.
void gather_pairs(Cell cell, uint first_entry, bool any_entry) {
  const uint entry = first_entry + gl_SubgroupInvocationID;
  uvec4 rectangle = uvec4(0u);
  uint spot = 0u;
  if (any_entry) {
    const uint light = s_lights[entry];
    const LightBounds sphere = view_bounds(frame, spheres[light]);
    spot = lights[light].type == LIGHT_SPOT ? PAIR_OF_SPOT : 0u;
    s_spheres[entry] = sphere;
    rectangle = rectangle_in_rows(sphere, cell);
  }
  const uint packed_rectangle = rectangle.x + CELL_TILES * rectangle.y | rectangle.z << 8 | spot;
  const SharedWork work = share_work(rectangle.z * rectangle.w);
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // spheres before other threads read them
  for (uint start = 0u; start < work.total; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    const WorkItem item = work_item(work, i);
    const uint its_rectangle = subgroupShuffle(packed_rectangle, item.owner);
    const uint across = its_rectangle >> 8 & 0xffu;
    const uint row = (its_rectangle & 0xffu) + item.number % across + CELL_TILES * (item.number / across);
    bool near = false;
    if (i < work.total) near = meets_row(s_spheres[first_entry + item.owner], row);
    gather_pair(packed_pair(first_entry + item.owner, row, its_rectangle & PAIR_OF_SPOT), near);
  }
}

// By all threads of the group together: entries [begin, end) of the piece, whose pairs there is room for.
void mark_share(Cell cell, uint begin, uint end) {
  // A few are spread over all subgroups.
  const uint share = clamp((end - begin + gl_NumSubgroups - 1u) / gl_NumSubgroups, 1u, gl_SubgroupSize);
  for (uint first = begin + gl_SubgroupID * share; first < end; first += gl_NumSubgroups * share)
    gather_pairs(cell, first, gl_SubgroupInvocationID < share && first + gl_SubgroupInvocationID < end);
  barrier();  // all pairs before they are tested
  const uint pairs = s_pair_count;
  for (uint first = gl_SubgroupID * gl_SubgroupSize; first < pairs; first += gl_WorkGroupSize.x) {
    const uint i = first + gl_SubgroupInvocationID;
    const Pair pair = pair_of(s_pairs[min(i, pairs - 1u)]);
    bool reached = i < pairs && reaches_row(pair);
#ifdef PRUNED
    reached = keeps_pair(cell, pair, reached);
#endif
    if (reached) atomicOr(s_bits[bit_word(pair.row, pair.entry / 32u)], 1u << (pair.entry % 32u));
  }
}

// By all threads of the group together.
void mark_lights(Cell cell, uint count) {
  const uint share = PAIRS / ROWS;  // lights whose pairs there is room for
  for (uint begin = 0u; begin < count; begin += share) {
    if (begin > 0u) {
      barrier();  // pairs are read before they are replaced
      if (gl_LocalInvocationIndex == 0u) s_pair_count = 0u;
      barrier();  // and counted anew
    }
    mark_share(cell, begin, min(begin + share, count));
  }
}

#endif
