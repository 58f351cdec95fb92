// Which lights of a piece reach which rows of its cell: a bit matrix in shared memory. Each subgroup takes lights of its own,
// and no barrier of the group stands between them. A first look at all pairs of light and row drops most; those that stay
// wait in the subgroup's part of shared memory until there are enough for the exact tests by all of its threads.
// Needs: TILE_PX, CELL_TILES, ROWS, MARK_WORDS, PAIRS; `frame`, `lights`, `spheres`; s_lights; PRUNED or not.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_MARKS
#define LAMP_METHODS_LAMPLIGHT_MARKS
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/light_bounds.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "methods/lamplight_rows.glsl"

shared uint s_bits[MARK_WORDS];  // PIECE_WORDS for each of ROWS
shared LightBounds s_spheres[PIECE];
shared uint s_pairs[PAIRS];  // two for each thread

uint bit_word(uint row, uint word) { return row * PIECE_WORDS + word; }

// By all threads of the group together, before a barrier.
void clear_marks() {
  for (uint i = gl_LocalInvocationIndex; i < MARK_WORDS; i += gl_WorkGroupSize.x) s_bits[i] = 0u;
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
  const LightBounds sphere = LightBounds(s_spheres[pair.entry].center, abs(s_spheres[pair.entry].radius));
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

// All below is for the threads of a subgroup together.
uint first_pair() { return gl_SubgroupID * 2u * gl_SubgroupSize; }

// Its i-th light in the piece. Neighbours go to different subgroups, because they tend to have as many pairs.
uint entry_of(uint i) { return gl_SubgroupID + i * gl_NumSubgroups; }

void load_spheres(uint count) {
  for (uint i = gl_SubgroupInvocationID; i < count; i += gl_SubgroupSize) {
    const uint light = s_lights[entry_of(i)];
    s_spheres[entry_of(i)] = view_bounds(frame, spheres[light]);
    if (lights[light].type == LIGHT_SPOT) s_spheres[entry_of(i)].radius *= -1.0;  // a sign is all that a spot takes
  }
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // spheres before other threads read them
}

// `count` waiting pairs from `first` on, at most one a thread.
void test_pairs(Cell cell, uint first, uint count) {
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // pairs are there before they are read
  const uint i = min(gl_SubgroupInvocationID, count - 1u);
  const Pair pair = pair_of(s_pairs[first_pair() + first + i]);
  bool reached = gl_SubgroupInvocationID < count && reaches_row(pair);
#ifdef PRUNED
  reached = keeps_pair(cell, pair, reached);
#endif
  if (reached) atomicOr(s_bits[bit_word(pair.row, pair.entry / 32u)], 1u << (pair.entry % 32u));
  subgroupBarrier();  // and read before others take their place
}

// Lights [0, count) of the piece.
void mark_lights(Cell cell, uint count) {
  const uint own = (count + gl_NumSubgroups - 1u - gl_SubgroupID) / gl_NumSubgroups;  // lights
  load_spheres(own);
  uint waiting = 0u;
  for (uint start = 0u; start < own * ROWS; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    const uint entry = entry_of(i / ROWS);
    const uint row = i % ROWS;
    bool near = false;
    uint spot = 0u;
    if (i < own * ROWS) {
      const LightBounds sphere = s_spheres[entry];
      spot = sphere.radius < 0.0 ? PAIR_OF_SPOT : 0u;
      near = may_reach_row(LightBounds(sphere.center, abs(sphere.radius)), row);
    }
    const uvec4 those = subgroupBallot(near);
    const uint place = first_pair() + waiting + subgroupBallotExclusiveBitCount(those);
    if (near) s_pairs[place] = packed_pair(entry, row, spot);
    waiting += subgroupBallotBitCount(those);
    if (waiting < gl_SubgroupSize) continue;
    waiting -= gl_SubgroupSize;
    test_pairs(cell, waiting, gl_SubgroupSize);
  }
  if (waiting > 0u) test_pairs(cell, 0u, waiting);
}

#endif
