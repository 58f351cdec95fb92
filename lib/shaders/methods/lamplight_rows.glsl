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
  uint first_slice;
};

shared vec4 s_x_edges[ROWS];
shared vec4 s_y_edges[ROWS];
shared vec4 s_lengths[ROWS];  // of the normals of the four edges
shared TileDepths s_depths[ROWS];

uvec2 tile_of_row(Cell cell, uint row) {
  const uint tile = (cell.first_row + row) % TILES;
  return cell.first_tile + uvec2(tile % CELL_TILES, tile / CELL_TILES);
}

// By one thread a row.
void load_sides(Cell cell, uint row) {
  const uvec2 tile = tile_of_row(cell, row);
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  s_x_edges[row] = x_edges;
  s_y_edges[row] = y_edges;
  s_lengths[row] = edge_lengths(x_edges, y_edges);
}

bool is_in_picture(uvec2 tile) { return all(lessThan(tile * TILE_PX, frame.size_px)); }

// The first look: depths, occupied parts, each of the four sides alone.
bool may_reach_row(LightBounds sphere, uint row) {
  const TileDepths depths = s_depths[row];
  return sphere_touches_depths(sphere, depths.z_near, depths.z_far) &&
         parts_near(sphere, depths.z_near, depths.scale, depths.mask) != 0u &&
         inside_edges(sphere.center, sphere.radius, s_x_edges[row], s_y_edges[row], s_lengths[row]);
}

// The depths of a row that a sphere can reach: of a slice the part that the sphere spans, which is never infinite.
TileRanges ranges_of_row(uint row, LightBounds sphere) {
#ifdef SLICED
  const float z = -sphere.center.z;
  return masked_range(max(s_depths[row].z_near, z - sphere.radius), min(s_depths[row].z_far, z + sphere.radius), ~0u);
#else
  return masked_range(s_depths[row].z_near, s_depths[row].z_far, s_depths[row].mask);
#endif
}

#endif
