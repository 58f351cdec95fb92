// Radial bounds (shared/radial.h) of lights from their shadow maps: a work group a light, or several, each with some rows
// of the map's blocks. A block of texels may light points whose directions lie around it, by what taps and the normal
// offset move; each cell that such a direction touches must reach as far as the farthest of them.
// Promise: shadow_of of the same map and filter is 0 beyond the bound. docs/methods/shadow-maps.md has the reasoning.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#include "common/atomic_load.glsl"
#include "shadow/parts/radial_cells.glsl"

layout(local_size_x_id = 1, local_size_x = 256) in;  // many idle with a small map
#include "shadow/parts/radial_blocks.glsl"
#include "shadow/parts/radial_raise.glsl"

layout(set = 0, binding = 3, scalar) readonly buffer JobBuffer { RadialJob jobs[]; };
layout(set = 0, binding = 4, scalar) buffer BoundBuffer { RadialBound bounds[]; };
layout(push_constant) uniform Push { uint job_count; };

void reach_of_block(uint light, Cut cut, uint block, float unit_m, float cells_scale) {
  const float stored = int(cut.size) > DIRECT_SIZE ? uintBitsToFloat(s_nearest_stored[block % HELD_BLOCKS])
                                              : farthest_of_block(light, cut, block);
  const RadialReach reaches = radial_reach_of(light, square_of(cut, block), vec2(place_of(cut, block)),
                                              float(cut.size), cells_scale);
  const float reach_m = radial_farthest_lit(light, radial_depth_of(light, stored)) * reaches.farthest;
  const uint value = reach_m < unit_m * float(RADIAL_ANY - 1u) ? uint(reach_m / unit_m * 1.00001) + 1u : RADIAL_ANY;
  raise(reaches.cells, value);
}

// By all threads of the group together.
void reach_of_blocks(uint light, Cut cut, uint first, uint end, float unit_m, float cells_scale) {
  const bool by_columns = int(cut.size) > DIRECT_SIZE;
  uint held = first;
  do {
    const uint held_end = HOLDS_ALL ? end : min(held + HELD_BLOCKS, end);
    if (by_columns) {
      farthest_of_blocks(light, cut, held, held_end);
      barrier();  // all texels before blocks reach
    }
    for (uint block = held + gl_LocalInvocationIndex; block < held_end; block += gl_WorkGroupSize.x)
      reach_of_block(light, cut, block, unit_m, cells_scale);
    if (!HOLDS_ALL && by_columns) barrier();  // all have reached before the next are held in their place
    held += HELD_BLOCKS;
  } while (!HOLDS_ALL && held < end);
}

float cells_scale_of(uint light) {
  return float(RADIAL_SIDE) * shadow_maps[light].scale / float(max(shadow_maps[light].side, 1u));
}

uint larger_bytes(uint a, uint b) {
  uint larger = 0u;
  for (uint k = 0u; k < 32u; k += 8u) larger |= max(a >> k & 255u, b >> k & 255u) << k;
  return larger;
}

void enlarge(uint light, uint i, uint word) {
  uint found = 0u;
  for (uint wanted = word; wanted != found; wanted = larger_bytes(found, word)) {
    const uint expected = found;
    found = atomicCompSwap(bounds[light].bytes[i / 4u][i % 4u], expected, wanted);
    if (found == expected) return;
  }
}

void write_bound(RadialJob job, bool known, float unit_m, float cells_scale) {
  const uint light = job.light;
  if (gl_LocalInvocationIndex == 0u && job.part == 0u) {
    bounds[light].position = shadow_maps[light].position;
    bounds[light].kind =
        !known ? RADIAL_NONE : shadow_maps[light].kind == SHADOW_SPOT ? RADIAL_SPOT : RADIAL_OCTAHEDRON;
    bounds[light].axis_x = shadow_maps[light].axis_x;
    bounds[light].scale = cells_scale;
    bounds[light].axis_z = shadow_maps[light].axis_z;
    bounds[light].unit_m = unit_m;
  }
  for (uint i = gl_LocalInvocationIndex; i < radial_first(RADIAL_LEVELS) / 4u; i += gl_WorkGroupSize.x) {
    uint word = 0u;
    for (uint k = 0u; k < 4u; ++k) word |= s_cells[4u * i + k] << (8u * k);
    if (!known) word = 0u;
    if (job.parts > 1u) {
      enlarge(light, i, word);
    } else {
      STORE_OF_DEVICE(bounds[light].bytes[i / 4u][i % 4u], word);
    }
  }
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= job_count) return;
  const uint thread = gl_LocalInvocationIndex;
  const RadialJob job = jobs[number];
  const uint light = job.light;
  const bool known = job.shows_all != 0u && shadow_maps[light].kind != SHADOW_NONE && radial_is_bounded(light);
  const float unit_m = shadow_maps[light].range_m / float(RADIAL_ANY);
  const float cells_scale = cells_scale_of(light);
  for (uint i = thread; i < RADIAL_SIDE * RADIAL_SIDE; i += gl_WorkGroupSize.x) s_cells[i] = 0u;
  if (known) {
    const Cut cut = cut_of(light);
    const uint parts = max(job.parts, 1u);
    const uint rows = cut.all_blocks >> cut.block_bits;
    const uint first = rows * job.part / parts << cut.block_bits;
    const uint end = rows * (job.part + 1u) / parts << cut.block_bits;
    barrier();  // initial values before blocks reach farther
    reach_of_blocks(light, cut, first, end, unit_m, cells_scale);
  }
  barrier();  // all blocks before the cells of the next level
  fill_levels();
  write_bound(job, known, unit_m, cells_scale);
}
