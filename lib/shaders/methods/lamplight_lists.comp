// A piece of a cell's lights by one work group: sorted, tested exactly against every tile that the light's rectangle
// covers, and written as one ascending list a tile.
// A bit matrix in shared memory (tiles x lights) holds who reaches what, so that each list is written once and in order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint CAPACITY = 384;  // entries of the longest piece, a multiple of 32
layout(constant_id = 4) const uint LIST_ENTRIES = 1;
#define BOUNDS BOUNDS_MASK
#define TEST TEST_EXACT
#define SPOT SPOT_CONE_SEGMENTS
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "lamplight/shared/counters.h"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer RangeBuffer { TileRanges ranges[]; };
layout(set = 0, binding = 3, scalar) readonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 4, scalar) readonly buffer RectangleBuffer { uvec2 rectangles[]; };
layout(set = 0, binding = 5, scalar) readonly buffer IndexBuffer { uint light_of_slot[]; };
layout(set = 0, binding = 6, scalar) readonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 7, scalar) readonly buffer PieceBuffer { LightPiece pieces[]; };
layout(set = 0, binding = 8, scalar) buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 9, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 10, scalar) buffer CounterBuffer { Counters counters; };
layout(set = 0, binding = 11, scalar) writeonly buffer SpanBuffer { LightSpan spans[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer ListBuffer { uint lists[]; };

const uint ROWS = 32u;  // tiles of a cell that are looked at together
const uint TILES = CELL_TILES * CELL_TILES;

shared uint s_slots[CAPACITY];
#define SORT_KEYS s_slots
#include "common/sort.glsl"

shared uint s_bits[CAPACITY];  // row t: the lights that reach tile t; ROWS rows of CAPACITY / 32 words
shared vec4 s_x_edges[ROWS];
shared vec4 s_y_edges[ROWS];
shared vec2 s_depths[ROWS];
shared uint s_masks[ROWS];
shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared bool s_fits;

uint bit_word(uint row, uint word) { return row * (CAPACITY / ROWS) + word; }

uvec2 tile_of_row(uvec2 first_tile, uint tile) { return first_tile + uvec2(tile % CELL_TILES, tile / CELL_TILES); }

// By one thread a row. Rows beyond the cell or the picture stay empty.
void load_row(uvec2 first_tile, uint first_row, uint row) {
  s_masks[row] = 0u;
  s_depths[row] = vec2(EMPTY_NEAR, EMPTY_FAR);
  const uvec2 tile = tile_of_row(first_tile, first_row + row);
  const uvec2 tiles = (frame.size_px + TILE_PX - 1u) / TILE_PX;
  if (first_row + row >= TILES || any(greaterThanEqual(tile, tiles))) return;
  const TileRanges range = ranges[tile.x + tiles.x * tile.y];
  s_masks[row] = range.mask;
  s_depths[row] = vec2(range.z_near[0], range.z_far[0]);
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  s_x_edges[row] = x_edges;
  s_y_edges[row] = y_edges;
}

bool reaches_row(LightBounds sphere, uint light, uint row) {
  TileRanges range = one_range(s_depths[row].x, s_depths[row].y);
  range.mask = s_masks[row];
  if (range.mask == 0u || !sphere_touches_depths(sphere, range.z_near[0], range.z_far[0])) return false;
  const uint parts = parts_near(sphere, range);
  TileSides sides;
  sides.x_edges = s_x_edges[row];
  sides.y_edges = s_y_edges[row];
  if (!sphere_touches_runs(sphere, sides, range, parts)) return false;
  if (lights[light].type != LIGHT_SPOT) return true;
  return spot_touches_tile(frame, lights[light], sides, range.z_near[0], range.z_far[0], parts);
}

// Sets the light's bit in the rows of the tiles that it reaches.
void mark_light(uvec2 first_tile, uint first_row, uint entry) {
  const uint slot = s_slots[entry];
  const uvec2 rectangle = rectangles[slot];
  const uvec2 low = max(rectangle & 0xffffu, first_tile) - first_tile;
  const uvec2 high = min((rectangle >> 16) - first_tile, uvec2(CELL_TILES - 1u));
  const LightBounds sphere = spheres[slot];
  const uint light = light_of_slot[slot];
  for (uint y = low.y; y <= high.y; ++y) {
    for (uint x = low.x; x <= high.x; ++x) {
      const uint row = x + CELL_TILES * y - first_row;  // wraps around for rows of an earlier round
      if (row < ROWS && reaches_row(sphere, light, row))
        atomicOr(s_bits[bit_word(row, entry / 32u)], 1u << (entry % 32u));
    }
  }
}

uint lights_before(uint row, uint word) {
  uint count = 0u;
  for (uint i = 0u; i < word; ++i) count += uint(bitCount(s_bits[bit_word(row, i)]));
  return count;
}

// By one thread: room for all rows' lists together, after a look that keeps the total from beginning anew.
void reserve_lists() {
  uint size = 0u;
  for (uint row = 0u; row < ROWS; ++row) {
    s_list_begin[row] = size;
    size += s_list_size[row];
  }
  const uint begin = totals.list_entries > LIST_ENTRIES ? LIST_ENTRIES : atomicAdd(totals.list_entries, size);
  s_fits = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin);
  for (uint row = 0u; row < ROWS; ++row) s_list_begin[row] += begin;
}

void write_list_word(uint row, uint word) {
  uint place = s_list_begin[row] + lights_before(row, word);
  for (uint bits = s_bits[bit_word(row, word)]; bits != 0u; bits &= bits - 1u)
    lists[place++] = light_of_slot[s_slots[word * 32u + uint(findLSB(bits))]];
}

void cull_rows(uvec2 first_tile, uint first_row, LightPiece piece, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint words = (count + 31u) / 32u;
  for (uint i = thread; i < CAPACITY; i += threads) s_bits[i] = 0u;
  if (thread < ROWS) load_row(first_tile, first_row, thread);
  barrier();  // rows and cleared bits before lights are tested
  for (uint entry = thread; entry < count; entry += threads) mark_light(first_tile, first_row, entry);
  barrier();  // all bits before they are counted
  if (thread < ROWS) s_list_size[thread] = lights_before(thread, words);
  barrier();  // sizes before room is made
  if (thread == 0u) reserve_lists();
  barrier();  // places before lists are written
  for (uint i = thread; s_fits && i < ROWS * words; i += threads) write_list_word(i % ROWS, i / ROWS);
  if (thread < ROWS && first_row + thread < TILES)
    spans[gl_WorkGroupID.x * TILES + first_row + thread] =
        s_fits ? LightSpan(s_list_begin[thread], s_list_size[thread]) : LightSpan(piece.begin | COARSE, count);
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const LightPiece piece = pieces[gl_WorkGroupID.x];
  const LightCell cell = cells[piece.cell];
  const bool last = gl_WorkGroupID.x + 1u == cell.first_piece + cell.pieces;
  const uint count = (last ? cell.end : pieces[gl_WorkGroupID.x + 1u].begin) - piece.begin;
  for (uint i = thread; i < count; i += gl_WorkGroupSize.x) s_slots[i] = entries[piece.begin + i];
  barrier();  // slots before they are sorted
  sort_keys(0u, count);

  const uint cells_wide = (frame.size_px.x + TILE_PX * CELL_TILES - 1u) / (TILE_PX * CELL_TILES);
  const uvec2 first_tile = uvec2(piece.cell % cells_wide, piece.cell / cells_wide) * CELL_TILES;
  bool all_fit = true;
  for (uint first_row = 0u; first_row < TILES; first_row += ROWS) {
    cull_rows(first_tile, first_row, piece, count);
    all_fit = all_fit && s_fits;
    barrier();  // rows and places are read before the next round replaces them
  }
  if (all_fit) return;
  // The piece itself stands in for the lists that did not fit: its lights, by now in order.
  for (uint i = thread; i < count; i += gl_WorkGroupSize.x) entries[piece.begin + i] = light_of_slot[s_slots[i]];
  if (thread == 0u) atomicAdd(counters.overflowed_cells, TILES);
}
