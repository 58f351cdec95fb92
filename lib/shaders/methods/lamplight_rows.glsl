// The rows of a cell that a work group looks at: tiles with their depths and sides, in shared memory. Without a depth
// buffer a row is a tile in a slice of depth.
// Needs: TILE_PX, CELL_TILES, ROWS; `frame`; SLICED or not. Whoever includes it fills s_depths.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_ROWS
#define LAMP_METHODS_LAMPLIGHT_ROWS
#include "common/mask_tests.glsl"
#include "common/tile_volume.glsl"

const uint TILES = CELL_TILES * CELL_TILES;  // a whole number of ROWS, which are whole lines of tiles

struct Cell {
  uvec2 first_tile;
  uint first_row;    // of the work group; its rows are of one slice
  uint rows;         // of the work group; a power of two, ROWS at most
  uint first_slice;
};

shared vec4 s_x_edges[CELL_TILES];  // of columns of tiles, from that of the first row on
shared vec4 s_y_edges[CELL_TILES];  // of lines of tiles, from that of the first row on
shared RectangleEdges s_edges;      // of all rows together
shared TileDepths s_depths[ROWS];

uvec2 tile_of_row(Cell cell, uint row) {
  const uint tile = (cell.first_row + row) % TILES;
  return cell.first_tile + uvec2(tile % CELL_TILES, tile / CELL_TILES);
}

// By one thread each for number `i` of CELL_TILES columns and as many lines.
void load_sides(Cell cell, uint i) {
  const uvec2 tile = uvec2(tile_of_row(cell, i).x, tile_of_row(cell, i * CELL_TILES).y);
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  s_x_edges[i] = x_edges;
  s_y_edges[i] = y_edges;
}

// By one thread.
void load_edges(Cell cell) {
  const uvec2 end_tile = tile_of_row(cell, cell.rows - 1u) + 1u;
  s_edges = rectangle_edges(frame, vec2(tile_of_row(cell, 0u) * TILE_PX), vec2(end_tile * TILE_PX));
}

vec4 x_edges_of_row(uint row) { return s_x_edges[row % CELL_TILES]; }
vec4 y_edges_of_row(uint row) { return s_y_edges[row / CELL_TILES]; }

bool is_in_picture(uvec2 tile) { return all(lessThan(tile * TILE_PX, frame.size_px)); }

// The depths of a row that a sphere can reach: of a slice the part that the sphere spans, which is never infinite.
TileDepths depths_in_reach(uint row, LightBounds sphere) {
#ifdef SLICED
  const float z = -sphere.center.z;
  const float z_near = max(s_depths[row].z_near, z - sphere.radius);
  const float z_far = min(s_depths[row].z_far, z + sphere.radius);
  return TileDepths(z_near, z_far, mask_scale(z_near, z_far), z_near <= z_far ? ~0u : 0u);
#else
  return s_depths[row];
#endif
}

#endif
