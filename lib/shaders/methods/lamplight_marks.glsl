// Which lights of a piece reach which tiles of its cell: rows of bits in shared memory, one a tile. A first look at depths
// drops most pairs; those that stay are gathered, so that the exact tests run with all threads of a subgroup.
// Needs: TILE_PX, CELL_TILES, PIECE, PAIRS; `frame`, `lights`, `spheres`, `tile_depths`; s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_MARKS
#define LAMP_METHODS_LAMPLIGHT_MARKS
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/sphere_rectangle.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "common/subgroup_work.glsl"

const uint ROWS = 32u;  // tiles of a cell that are looked at together: whole rows of tiles, CELL_TILES divides it
const uint TILES = CELL_TILES * CELL_TILES;

shared uint s_bits[PIECE];  // row t: the lights that reach tile t; ROWS rows of PIECE / 32 words
shared vec4 s_x_edges[ROWS];
shared vec4 s_y_edges[ROWS];
shared TileDepths s_depths[ROWS];
shared LightBounds s_spheres[PIECE];
shared uint s_pairs[PAIRS];
shared uint s_pair_count;

uint bit_word(uint row, uint word) { return row * (PIECE / ROWS) + word; }

// By one thread a row. Rows beyond the cell or the picture stay empty.
void load_row(uvec2 cell_tile, uint first_row, uint row) {
  s_depths[row] = TileDepths(EMPTY_NEAR, EMPTY_FAR, 0u, 0u);
  const uvec2 tile = cell_tile + uvec2((first_row + row) % CELL_TILES, (first_row + row) / CELL_TILES);
  const uvec2 tiles = (frame.size_px + TILE_PX - 1u) / TILE_PX;
  if (first_row + row >= TILES || any(greaterThanEqual(tile, tiles))) return;
  s_depths[row] = tile_depths[tile.x + tiles.x * tile.y];
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  s_x_edges[row] = x_edges;
  s_y_edges[row] = y_edges;
}

// By all threads of the group together, before a barrier.
void prepare_rows(uvec2 cell_tile, uint first_row, uint count) {
  const uint rows = min(TILES, ROWS);
  const uint words = (count + 31u) / 32u;
  for (uint i = gl_LocalInvocationIndex; i < rows * words; i += gl_WorkGroupSize.x)
    s_bits[bit_word(i % rows, i / rows)] = 0u;
  for (uint row = gl_LocalInvocationIndex; row < rows; row += gl_WorkGroupSize.x) load_row(cell_tile, first_row, row);
  if (gl_LocalInvocationIndex == 0u) s_pair_count = 0u;
}

// A light of the piece and a row.
const uint PAIR_ENTRY_BITS = 16u;
const uint PAIR_OF_SPOT = 0x80000000u;
uint pair_of(uint entry, uint row, uint spot) { return entry | row << PAIR_ENTRY_BITS | spot; }

TileRanges ranges_of_row(uint row) { return masked_range(s_depths[row].z_near, s_depths[row].z_far, s_depths[row].mask); }

void mark_if_reached(uint pair) {
  const uint entry = pair & (1u << PAIR_ENTRY_BITS) - 1u;
  const uint row = (pair & ~PAIR_OF_SPOT) >> PAIR_ENTRY_BITS;
  const LightBounds sphere = s_spheres[entry];
  const TileRanges ranges = ranges_of_row(row);
  const uint parts = parts_near(sphere, ranges);
  TileSides sides;
  sides.x_edges = s_x_edges[row];
  sides.y_edges = s_y_edges[row];
  bool reached = sphere_touches_runs(sphere, sides, ranges, parts);
  if (reached && (pair & PAIR_OF_SPOT) != 0u)
    reached = spot_touches_tile(frame, lights[s_lights[entry]], sides, ranges.z_near[0], ranges.z_far[0], parts);
  if (reached) atomicOr(s_bits[bit_word(row, entry / 32u)], 1u << (entry % 32u));
}

// The part of a light's rectangle that lies in the rows: first column and row, width, height.
uvec4 rectangle_in_rows(LightBounds sphere, uvec2 cell_tile, uint first_row) {
  uvec4 tiles;
  tiles_of_sphere(frame, sphere, TILE_PX, tiles);
  const uvec2 first = tiles.xy;
  const uvec2 last = tiles.zw;
  const uvec2 begin = cell_tile + uvec2(0u, first_row / CELL_TILES);
  const uvec2 end = begin + uvec2(CELL_TILES, min(ROWS / CELL_TILES, CELL_TILES));
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

// Some entries by one subgroup, a thread each: their tiles are spread over all of its threads.
void gather_pairs(uvec2 cell_tile, uint first_row, uint first_entry, bool any_entry) {
  const uint entry = first_entry + gl_SubgroupInvocationID;
  uvec4 rectangle = uvec4(0u);
  uint spot = 0u;
  if (any_entry) {
    const uint light = s_lights[entry];
    const LightBounds sphere = spheres[light];
    spot = lights[light].type == LIGHT_SPOT ? PAIR_OF_SPOT : 0u;
    s_spheres[entry] = sphere;
    rectangle = rectangle_in_rows(sphere, cell_tile, first_row);
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
    if (i < work.total) near = sphere_meets_mask(s_spheres[first_entry + item.owner], ranges_of_row(row));
    gather_pair(pair_of(first_entry + item.owner, row, its_rectangle & PAIR_OF_SPOT), near);
  }
}

// By all threads of the group together: entries [begin, end) of the piece, whose pairs there is room for.
void mark_share(uvec2 cell_tile, uint first_row, uint begin, uint end) {
  // A few are spread over all subgroups.
  const uint share = clamp((end - begin + gl_NumSubgroups - 1u) / gl_NumSubgroups, 1u, gl_SubgroupSize);
  for (uint first = begin + gl_SubgroupID * share; first < end; first += gl_NumSubgroups * share)
    gather_pairs(cell_tile, first_row, first, gl_SubgroupInvocationID < share && first + gl_SubgroupInvocationID < end);
  barrier();  // all pairs before they are tested
  const uint pairs = s_pair_count;
  for (uint i = gl_LocalInvocationIndex; i < pairs; i += gl_WorkGroupSize.x) mark_if_reached(s_pairs[i]);
}

// By all threads of the group together.
void mark_lights(uvec2 cell_tile, uint first_row, uint count) {
  const uint share = PAIRS / min(TILES, ROWS);  // lights whose pairs there is room for
  for (uint begin = 0u; begin < count; begin += share) {
    if (begin > 0u) {
      barrier();  // pairs are read before they are replaced
      if (gl_LocalInvocationIndex == 0u) s_pair_count = 0u;
      barrier();  // and counted anew
    }
    mark_share(cell_tile, first_row, begin, min(begin + share, count));
  }
}

#endif
