// A block of lights by one work group: bounds, rectangle of tiles, a first look at the depths; the survivors are kept in
// order and counted in the cells that they may reach.
// Promise: reads every light once; what later passes know of a light is what is stored here.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint CELLS = 1;
layout(constant_id = 4) const uint BLOCK = 256;  // lights
#define BOUNDS BOUNDS_MASK
#include "common/light_bounds.glsl"
#include "common/mask_tests.glsl"
#include "common/sphere_rectangle.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer RangeBuffer { TileRanges ranges[]; };
layout(set = 0, binding = 3, scalar) readonly buffer CellDepthBuffer { vec2 cell_depths[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer RectangleBuffer { uvec2 rectangles[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer IndexBuffer { uint light_of_slot[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer SurvivorBuffer { uint survivors[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer CountBuffer { uint counts[]; };  // [block][cell]

shared uint s_counts[CELLS];
shared uint s_alive[32];  // a bit for each thread; 1024 threads at most

#define VISIT_CELL(cell, slot) atomicAdd(s_counts[cell], 1u)
#include "methods/lamplight_cells.glsl"

// Lights of few tiles are held against each tile's depths at once: most of them are hidden or hang in the air.
const uint FEW_TILES = 4u;

bool meets_depths(LightBounds sphere, uvec4 tiles) {
  const uvec2 size = tiles.zw - tiles.xy + 1u;
  if (size.x * size.y > FEW_TILES) return true;
  for (uint i = 0u; i < size.x * size.y; ++i) {
    const uvec2 tile = tiles.xy + uvec2(i % size.x, i / size.x);
    const TileRanges range = ranges[tile.x + grid_width(TILE_PX) * tile.y];
    if (sphere_meets_mask(sphere, range)) return true;
  }
  return false;
}

uint alive_before(uint thread) {
  uint count = uint(bitCount(s_alive[thread / 32u] & ((1u << (thread % 32u)) - 1u)));
  for (uint word = 0u; word < thread / 32u; ++word) count += uint(bitCount(s_alive[word]));
  return count;
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  for (uint cell = thread; cell < CELLS; cell += threads) s_counts[cell] = 0u;
  const uint first = gl_WorkGroupID.x * BLOCK;
  uint kept = 0u;
  for (uint start = 0u; start < BLOCK; start += threads) {
    if (thread < 32u) s_alive[thread] = 0u;
    barrier();  // cleared, and on the first round the counts, before they are added to
    const uint light = first + start + thread;
    LightBounds sphere = LightBounds(vec3(0.0), REACHES_NOTHING);
    if (light < frame.light_count) sphere = light_bounds(frame, lights[light]);
    uvec4 tiles;
    const bool alive = tiles_of_sphere(frame, sphere, TILE_PX, tiles) && meets_depths(sphere, tiles);
    if (alive) atomicOr(s_alive[thread / 32u], 1u << (thread % 32u));
    barrier();  // all bits before they are counted
    const uint slot = first + kept + alive_before(thread);
    if (alive) {
      spheres[slot] = sphere;
      rectangles[slot] = tiles.xy | tiles.zw << 16;
      light_of_slot[slot] = light;
    }
    visit_cells(alive, CellVisit(tiles, -sphere.center.z - sphere.radius, -sphere.center.z + sphere.radius, slot));
    for (uint word = 0u; word < (threads + 31u) / 32u; ++word) kept += uint(bitCount(s_alive[word]));
    barrier();  // the bits are read before the next round clears them
  }
  if (thread == 0u) survivors[gl_WorkGroupID.x] = kept;
  for (uint cell = thread; cell < CELLS; cell += threads) counts[gl_WorkGroupID.x * CELLS + cell] = s_counts[cell];
}
