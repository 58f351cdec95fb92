// One work group a tile: a bit for every light, in the order of depth, that touches its side planes; no depth is read.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "common/tile_volume.glsl"
#include "common/volume_tests.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 8;
layout(constant_id = 2) const uint WORDS = 1;  // words a tile: light capacity / 32, rounded up
layout(constant_id = 3) const uint FURTHER = 0;  // FURTHER_*
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer SortedBuffer { LightBounds sorted[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer BitBuffer { uint bits[]; };
layout(set = 0, binding = 3, scalar) readonly buffer OrderBuffer { uint order[]; };  // FURTHER alone
#define RADIAL_BINDING 4
layout(set = 0, binding = 5, scalar) readonly buffer RecordBuffer { Light records[]; };  // SHAPES alone
#define RECORD_OF(id) records[id]
#include "common/further_tests.glsl"

shared uint s_found[8];  // 256 threads at most, one bit each

// The further tests of the tile, at any depth.
bool passes_in_tile(uint rank, uvec2 tile) {
  if (FURTHER == 0u) return true;
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  return passes_further_tests(frame, order[rank], sorted[rank], x_edges, y_edges,
                              vec2(from_eye(frame, -3e38), 3e38));
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uvec2 tile = gl_WorkGroupID.xy;
  const uint base = (tile.x + gl_NumWorkGroups.x * tile.y) * WORDS;
  vec4 planes[4];
  side_planes(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), planes);
  for (uint first = 0u; first < light_count_of(frame); first += gl_WorkGroupSize.x) {
    if (thread < 8u) s_found[thread] = 0u;
    barrier();  // cleared words before bits are set
    if (first + thread < light_count_of(frame) && sphere_touches_sides(sorted[first + thread], planes) &&
        passes_in_tile(first + thread, tile))
      atomicOr(s_found[thread / 32u], 1u << (thread % 32u));
    barrier();  // all bits before the words are written
    if (thread < gl_WorkGroupSize.x / 32u && first / 32u + thread < WORDS)
      bits[base + first / 32u + thread] = s_found[thread];
    barrier();  // words written before they are cleared again
  }
}
