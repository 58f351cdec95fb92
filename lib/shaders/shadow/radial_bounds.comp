// Radial bounds (shared/radial.h) of lights from their shadow maps: a work group a light. A block of texels may light
// points whose directions lie around it, by what taps and the normal offset move; each cell that such a direction
// touches must reach as far as the farthest of them.
// Promise: shadow_of of the same map and filter is 0 beyond the bound. docs/methods/shadow-maps.md has the reasoning.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#include "common/radial_cells.glsl"
#include "shadow/parts/radial_reach.glsl"

layout(local_size_x_id = 1, local_size_x = 256) in;  // many threads are fast where few lights have large maps

layout(set = 0, binding = 3, scalar) readonly buffer JobBuffer { RadialJob jobs[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer BoundBuffer { RadialBound bounds[]; };
layout(push_constant) uniform Push { uint job_count; };

const uint CELLS = RADIAL_SIDE * RADIAL_SIDE;
const uint BLOCKS = 16u;             // a side of a square, a quarter of a cell's angle and less
const uint OCTAHEDRON_BLOCKS = 32u;  // which holds all directions
const uint LEAST_BLOCK = 2u;         // texels; all round a light single ones say hardly more, and take longer
const uint MOST_BLOCKS = max(OCTAHEDRON_BLOCKS * OCTAHEDRON_BLOCKS, SQUARES_A_LIGHT * BLOCKS * BLOCKS);
shared uint s_bytes[CELLS];
shared uint s_nearest_stored[MOST_BLOCKS];  // bits of near / w of a block's farthest texel

void reach(RadialCells cells, uint value) {
  if (!cells.any) return;
  for (uint y = cells.first.y; y <= cells.last.y; ++y)
    for (uint x = cells.first.x; x <= cells.last.x; ++x) atomicMax(s_bytes[y * RADIAL_SIDE + x], value);
}

// A thread takes a column of a block; those of a row of blocks lie together in memory.
void farthest_of_blocks(uint light, uint squares, uint side, uint blocks) {
  const uint size = side / blocks;
  for (uint column = gl_LocalInvocationIndex; column < squares * blocks * side; column += gl_WorkGroupSize.x) {
    const uint row = column / side;  // of blocks, in all squares
    const uint x = column % side;
    const ivec2 first = ivec2(x, row % blocks * size);
    const float stored = radial_least_of_column(shadow_square(light, row / blocks), first, int(size));
    atomicMin(s_nearest_stored[row * blocks + x / size], floatBitsToUint(stored));
  }
}

void reach_of_block(uint light, uint square, uvec2 first, uint size, float stored, float unit_m, float scale) {
  const RadialBox box = radial_box(light, square, vec2(first), float(size));
  const float w = radial_farthest_lit(light, radial_depth_of(light, stored));
  const float reach_m = w * radial_longest(light, box);
  const uint value = reach_m < unit_m * float(RADIAL_ANY - 1u) ? uint(reach_m / unit_m * 1.00001) + 1u : RADIAL_ANY;
  if (shadow_maps[light].kind == SHADOW_SPOT) {
    reach(radial_cells_of_spot(scale, box.low, box.high), value);
  } else {
    for (uint octants = radial_octants(box.low, box.high); octants != 0u; octants &= octants - 1u)
      reach(radial_cells_of_octant(uint(findLSB(octants)), box.low, box.high), value);
  }
}

RadialBound header_of(uint light, bool known) {
  RadialBound bound;
  bound.position = shadow_maps[light].position;
  bound.kind = !known ? RADIAL_NONE : shadow_maps[light].kind == SHADOW_SPOT ? RADIAL_SPOT : RADIAL_OCTAHEDRON;
  bound.axis_x = shadow_maps[light].axis_x;
  bound.axis_z = shadow_maps[light].axis_z;
  bound.scale = float(RADIAL_SIDE) * shadow_maps[light].scale / float(max(shadow_maps[light].side, 1u));
  bound.unit_m = shadow_maps[light].range_m / float(RADIAL_ANY);
  return bound;
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= job_count) return;
  const uint thread = gl_LocalInvocationIndex;
  const uint light = jobs[number].light;
  const uint kind = shadow_maps[light].kind;
  const bool known = jobs[number].shows_all != 0u && kind != SHADOW_NONE && radial_is_bounded(light);
  const RadialBound bound = header_of(light, known);
  if (thread < CELLS) s_bytes[thread] = known ? 0u : RADIAL_ANY;
  barrier();  // initial values before blocks reach farther
  const uint side = shadow_maps[light].side;
  const uint blocks = min(side / (kind == SHADOW_SPOT ? 1u : LEAST_BLOCK),
                          kind == SHADOW_OCTAHEDRON ? OCTAHEDRON_BLOCKS : BLOCKS);
  const uint squares = !known ? 0u : kind == SHADOW_FACES ? SQUARES_A_LIGHT : 1u;
  const uint all_blocks = squares * blocks * blocks;
  for (uint i = thread; i < all_blocks; i += gl_WorkGroupSize.x) s_nearest_stored[i] = floatBitsToUint(1.0);
  barrier();  // initial values before texels are nearer
  farthest_of_blocks(light, squares, side, blocks);
  barrier();  // all texels before blocks reach
  for (uint i = thread; i < all_blocks; i += gl_WorkGroupSize.x)
    reach_of_block(light, i / (blocks * blocks), uvec2(i % blocks, i / blocks % blocks) * (side / blocks), side / blocks,
                   uintBitsToFloat(s_nearest_stored[i]), bound.unit_m, bound.scale);
  barrier();  // all blocks before bytes are packed
  if (thread == 0u) {
    bounds[light].position = bound.position;
    bounds[light].kind = bound.kind;
    bounds[light].axis_x = bound.axis_x;
    bounds[light].scale = bound.scale;
    bounds[light].axis_z = bound.axis_z;
    bounds[light].unit_m = bound.unit_m;
  }
  if (thread >= CELLS / 4u) return;
  uint word = 0u;
  for (uint i = 0u; i < 4u; ++i) word |= s_bytes[thread * 4u + i] << (8u * i);
  bounds[light].bytes[thread / 4u][thread % 4u] = word;
}
