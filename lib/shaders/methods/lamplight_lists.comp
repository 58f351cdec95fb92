// A piece of a cell's lights by one work group: put in order, tested exactly against every tile that the light's rectangle
// covers, and written as one ascending list a tile.
// A bit matrix in shared memory (tiles x lights) holds who reaches what, so that each list is written once and in order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint BLOCK = 256;      // lights
layout(constant_id = 4) const uint CELLS = 1;
layout(constant_id = 5) const uint PIECE = 256;      // entries, a multiple of 32
layout(constant_id = 6) const uint LIST_ENTRIES = 1;
layout(constant_id = 7) const uint WINDOW = 320;     // PIECE + 64
layout(constant_id = 8) const uint RUN_WORDS = 8;    // bits of a block
layout(constant_id = 9) const uint MAY_WRAP = 0;     // 1: all lists together might have 2^32 entries
#define BOUNDS BOUNDS_MASK
#define TEST TEST_EXACT
#define SPOT SPOT_CONE_SEGMENTS
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "common/subgroup_work.glsl"
#include "lamplight/shared/counters.h"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) readonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 4, scalar) readonly buffer ReachBuffer { LightReach reaches[]; };
layout(set = 0, binding = 5, scalar) readonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 6, scalar) readonly buffer PieceBuffer { LightPiece pieces[]; };
layout(set = 0, binding = 7, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 8, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
layout(set = 0, binding = 9, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 10, scalar) buffer CounterBuffer { Counters counters; };
layout(set = 0, binding = 11, scalar) writeonly buffer SpanBuffer { LightSpan spans[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(set = 0, binding = 13, scalar) writeonly buffer PieceListBuffer { uint piece_lists[]; };

const uint ROWS = 32u;  // tiles of a cell that are looked at together: whole rows of tiles, CELL_TILES divides it
const uint TILES = CELL_TILES * CELL_TILES;

shared uint s_bits[PIECE];  // row t: the lights that reach tile t; ROWS rows of PIECE / 32 words
shared vec4 s_x_edges[ROWS];
shared vec4 s_y_edges[ROWS];
shared TileDepths s_depths[ROWS];
shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared uint s_base;

#include "methods/lamplight_order.glsl"

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

bool reaches_row(LightBounds sphere, uint light, bool is_spot, uint row) {
  const TileRanges range = masked_range(s_depths[row].z_near, s_depths[row].z_far, s_depths[row].mask);
  if (!sphere_touches_depths(sphere, range.z_near[0], range.z_far[0])) return false;
  const uint parts = parts_near(sphere, range);
  TileSides sides;
  sides.x_edges = s_x_edges[row];
  sides.y_edges = s_y_edges[row];
  if (parts == 0u || !sphere_touches_runs(sphere, sides, range, parts)) return false;
  return !is_spot ||
         spot_touches_tile(frame, lights[light], sides, range.z_near[0], range.z_far[0], parts);
}

// The part of a light's rectangle that lies in the rows: first column and row, width, height.
uvec4 rectangle_in_rows(LightReach reach, uvec2 cell_tile, uint first_row) {
  const uint last_packed = reach.last & ~REACH_OF_SPOT;
  const uvec2 first = uvec2(reach.first & 0xffffu, reach.first >> 16);
  const uvec2 last = uvec2(last_packed & 0xffffu, last_packed >> 16);
  const uvec2 begin = cell_tile + uvec2(0u, first_row / CELL_TILES);
  const uvec2 end = begin + uvec2(CELL_TILES, min(ROWS / CELL_TILES, CELL_TILES));
  if (any(greaterThanEqual(first, end)) || any(lessThan(last, begin))) return uvec4(0u);
  const uvec2 low = max(first, begin) - begin;
  return uvec4(low, min(last, end - 1u) - begin + 1u - low);
}

// Some entries by one subgroup, a thread each: their tiles are spread over all of its threads.
void mark_lights(uvec2 cell_tile, uint first_row, uint entry, bool any_entry) {
  uint light = 0u;
  LightBounds sphere = LightBounds(vec3(0.0), 0.0);
  uvec4 rectangle = uvec4(0u);
  bool is_spot = false;
  if (any_entry) {
    light = s_lights[entry];
    sphere = spheres[light];
    const LightReach reach = reaches[light];
    rectangle = rectangle_in_rows(reach, cell_tile, first_row);
    is_spot = (reach.last & REACH_OF_SPOT) != 0u;
  }
  const SharedWork work = share_work(rectangle.z * rectangle.w);
  for (uint start = 0u; start < work.total; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    const WorkItem item = work_item(work, i);
    const uint corner = subgroupShuffle(rectangle.x + CELL_TILES * rectangle.y, item.owner);
    const uint across = subgroupShuffle(rectangle.z, item.owner);
    const vec3 center = subgroupShuffle(sphere.center, item.owner);
    const float radius = subgroupShuffle(sphere.radius, item.owner);
    const uint its_light = subgroupShuffle(light, item.owner);
    const uint its_entry = subgroupShuffle(entry, item.owner);
    const bool its_kind = subgroupShuffle(is_spot, item.owner);
    if (i >= work.total) continue;
    const uint row = corner + item.number % across + CELL_TILES * (item.number / across);
    if (reaches_row(LightBounds(center, radius), its_light, its_kind, row))
      atomicOr(s_bits[bit_word(row, its_entry / 32u)], 1u << (its_entry % 32u));
  }
}

void mark_all_lights(uvec2 cell_tile, uint first_row, uint count) {
  // Short pieces are spread over all subgroups.
  const uint share = clamp((count + gl_NumSubgroups - 1u) / gl_NumSubgroups, 1u, gl_SubgroupSize);
  for (uint first = gl_SubgroupID * share; first < count; first += gl_NumSubgroups * share) {
    const uint entry = first + gl_SubgroupInvocationID;
    mark_lights(cell_tile, first_row, entry, gl_SubgroupInvocationID < share && entry < count);
  }
}

uint lights_before(uint row, uint word) {
  uint count = 0u;
  for (uint i = 0u; i < word; ++i) count += uint(bitCount(s_bits[bit_word(row, i)]));
  return count;
}

// Room for all rows' lists together. By one thread; where the total could begin anew, after a look at it.
void reserve_lists(uint size) {
  const bool full = MAY_WRAP != 0u && totals.list_entries > LIST_ENTRIES;
  const uint begin = full ? LIST_ENTRIES : atomicAdd(totals.list_entries, size);
  s_base = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin) ? begin : ~0u;
}

void write_list_word(uint row, uint word) {
  uint place = s_base + s_list_begin[row] + lights_before(row, word);
  for (uint bits = s_bits[bit_word(row, word)]; bits != 0u; bits &= bits - 1u)
    lists[place++] = s_lights[word * 32u + uint(findLSB(bits))];
}

// By all threads of the group together, before a barrier.
void prepare_rows(uvec2 cell_tile, uint first_row, uint count) {
  const uint rows = min(TILES, ROWS);
  const uint words = (count + 31u) / 32u;
  for (uint i = gl_LocalInvocationIndex; i < rows * words; i += gl_WorkGroupSize.x)
    s_bits[bit_word(i % rows, i / rows)] = 0u;
  for (uint row = gl_LocalInvocationIndex; row < rows; row += gl_WorkGroupSize.x) load_row(cell_tile, first_row, row);
}

// Returns whether the lists fit.
bool cull_rows(uvec2 cell_tile, uint first_row, LightPiece piece, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint rows = min(TILES, ROWS);
  const uint words = (count + 31u) / 32u;
  mark_all_lights(cell_tile, first_row, count);
  barrier();  // all bits before they are counted
  for (uint row = thread; row < rows; row += threads) s_list_size[row] = lights_before(row, words);
  barrier();  // sizes before they are added up
  for (uint row = thread; row < rows; row += threads) {
    uint begin = 0u;
    for (uint i = 0u; i < row; ++i) begin += s_list_size[i];
    s_list_begin[row] = begin;
    if (row == rows - 1u) reserve_lists(begin + s_list_size[row]);
  }
  barrier();  // places before lists are written
  const bool fits = s_base != ~0u;
  for (uint i = thread; fits && i < rows * words; i += threads) write_list_word(i % rows, i / rows);
  for (uint row = thread; row < rows; row += threads)
    spans[gl_WorkGroupID.x * TILES + first_row + row] =
        fits ? LightSpan(s_base + s_list_begin[row], s_list_size[row]) : LightSpan(piece.begin | COARSE, count);
  return fits;
}

void main() {
  const LightPiece piece = pieces[gl_WorkGroupID.x];
  const LightCell cell = cells[piece.cell];
  const uint end = min(piece.begin + PIECE, cell.end);
  const uint count = end - piece.begin;
  const uint cell_begin = piece.begin - (gl_WorkGroupID.x - cell.first_piece) * PIECE;
  const uint cells_wide = (frame.size_px.x + TILE_PX * CELL_TILES - 1u) / (TILE_PX * CELL_TILES);
  const uvec2 cell_tile = uvec2(piece.cell % cells_wide, piece.cell / cells_wide) * CELL_TILES;
  prepare_rows(cell_tile, 0u, count);
  order_lights(piece.cell, cell_begin, cell.end, piece.begin, end);
  bool all_fit = true;
  for (uint first_row = 0u; first_row < TILES; first_row += ROWS) {
    if (first_row > 0u) {
      barrier();  // rows and places are read before they are replaced
      prepare_rows(cell_tile, first_row, count);
      barrier();  // rows and cleared bits before lights are tested
    }
    const bool fits = cull_rows(cell_tile, first_row, piece, count);
    all_fit = all_fit && fits;
  }
  if (all_fit) return;
  // The piece's lights stand in for the lists that did not fit.
  for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x)
    piece_lists[piece.begin + i] = s_lights[i];
  if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.overflowed_cells, TILES);
}
