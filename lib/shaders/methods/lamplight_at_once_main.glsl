// All of it at once, where lights are few: a work group is a cell, reads its depths, looks at every light, tests those
// that may reach the cell exactly against its tiles, and writes their lists. A list has room for all lights, so nothing
// is counted first, and nothing can be too much.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint HELD = 2;         // up to MOST_HELD
layout(constant_id = 4) const uint LIST_ROOM = 128;  // lights of a list, PIECE at most
layout(constant_id = 5) const uint PAIRS = 1024;     // of light and row that wait in shared memory
layout(constant_id = 6) const uint ROWS = 16;        // tiles of the cell
layout(constant_id = 7) const uint MARK_WORDS = 64;  // PIECE_WORDS for each of them
layout(constant_id = 8) const bool BITS = false;     // the container: bits, or lists
layout(constant_id = 9) const uint SAMPLES = 1;      // a pixel
layout(constant_id = 10) const uint FURTHER = 0;     // FURTHER_*
const bool LIGHTS_MISS = false;                      // a work group has all rows of its cell
#include "methods/lamplight_exact.glsl"

layout(set = 0, binding = 3) uniform DepthSquares depth_squares;
layout(set = 0, binding = 4, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer RowBuffer { uint rows[]; };    // LightSpan, or PIECE_WORDS words
layout(set = 0, binding = 6, scalar) writeonly buffer ListBuffer { uint lists[]; };  // of rows, or with BITS of cells
#define RADIAL_BINDING 7
#ifdef PRUNED
layout(set = 0, binding = 8) uniform DepthImage depth_image;
#endif

shared uint s_lights[PIECE];
shared uint s_words[PIECE_WORDS];  // a bit for each light that may reach the cell
#include "methods/lamplight_marks.glsl"
#include "methods/lamplight_row_lists.glsl"
#include "methods/lamplight_tile_depths.glsl"

// By all threads of the group together, before a barrier.
void load_rows(Cell cell) {
  if (gl_LocalInvocationIndex < CELL_TILES) load_sides(cell, gl_LocalInvocationIndex);
  for (uint row = gl_SubgroupID; row < ROWS; row += gl_NumSubgroups) {
    const uvec2 tile = tile_of_row(cell, row);
    TileDepths depths = TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
    if (is_in_picture(tile)) depths = depths_of_tile(tile);
    if (subgroupElect()) s_depths[row] = depths;
  }
}

// By all threads of the group together, before a barrier.
void look_at_all_lights(vec2 depths) {
  const vec2 corner_px = vec2(gl_WorkGroupID.xy * TILE_PX * CELL_TILES);
  const vec2 end_px = min(corner_px + float(TILE_PX * CELL_TILES), vec2(frame.size_px));
  const RectangleEdges sides = rectangle_edges(frame, corner_px, end_px);
  for (uint light = gl_LocalInvocationIndex; light < light_count_of(frame); light += gl_WorkGroupSize.x) {
    const LightBounds sphere = view_bounds(frame, spheres[light]);
    if (sphere_touches_depths(sphere, depths.x, depths.y) && inside_edges(sphere.center, sphere.radius, sides))
      atomicOr(s_words[light / 32u], 1u << (light % 32u));
  }
}

// By all threads of the group together, before a barrier. Returns how many lights the cell has.
uint list_lights() {
  uint before = 0u;  // in the words before
  for (uint word = 0u; word < PIECE_WORDS; ++word) {
    const uint bits = s_words[word];
    for (uint bit = gl_LocalInvocationIndex; bit < 32u; bit += gl_WorkGroupSize.x)
      if ((bits & 1u << bit) != 0u)
        s_lights[before + uint(bitCount(bits & (1u << bit) - 1u))] = word * 32u + bit;
    before += uint(bitCount(bits));
  }
  return before;
}

void write_rows(uint cell, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint words = (count + 31u) / 32u;
  const uint first_row = cell * ROWS;
  if (BITS) {
    write_bits(first_row, ROWS);
    for (uint i = thread; i < count; i += gl_WorkGroupSize.x) lists[cell * PIECE + i] = s_lights[i];
    return;
  }
  for (uint i = thread; i < ROWS * words * WORD_PARTS; i += gl_WorkGroupSize.x)
    write_list_part(i % ROWS, i / ROWS, (first_row + i % ROWS) * LIST_ROOM);
  for (uint row = thread; row < ROWS; row += gl_WorkGroupSize.x) {
    rows[2u * (first_row + row)] = (first_row + row) * LIST_ROOM;
    rows[2u * (first_row + row) + 1u] = lights_before(row, words);
  }
}

void main() {
  const uint index = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  if (light_count_of(frame) == 0u) {
    if (gl_LocalInvocationIndex == 0u) cells[index] = LightCell(index, 0u, 0u);
    return;
  }
  const Cell cell = Cell(gl_WorkGroupID.xy * CELL_TILES, 0u, ROWS, 0u);
  if (gl_LocalInvocationIndex == 0u) clear_cell_depths();
  if (gl_LocalInvocationIndex < PIECE_WORDS) s_words[gl_LocalInvocationIndex] = 0u;
  clear_marks();
  barrier();  // initial values before the first tile
  load_rows(cell);
  barrier();  // every tile before the cell
  look_at_all_lights(depths_of_cell());
  barrier();  // all lights before they are counted
  const uint count = list_lights();
  barrier();  // lights before they are tested
  mark_lights(cell, count);
  barrier();  // all marks before they are written
  if (gl_LocalInvocationIndex == 0u) cells[index] = LightCell(index, count == 0u ? 0u : 1u, count);
  write_rows(index, count);
}
