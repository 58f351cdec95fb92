// One thread a tile: its planes or its cone, kept until size or projection changes.
// Based on: Primal engine, listing 4; Adventures in Deferred Rendering: planes straight from the projection matrix.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/tile_volume.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint TILE_PX = 16;
layout(constant_id = 1) const uint TEST = 0;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) writeonly buffer FrustaBuffer { vec4 frusta[]; };

void main() {
  const uvec2 tiles = squares_across(frame, TILE_PX);
  const uint index = gl_GlobalInvocationID.x;
  if (index >= tiles.x * tiles.y) return;
  const uvec2 tile = uvec2(index % tiles.x, index / tiles.x);
  const vec2 min_px = vec2(tile * TILE_PX);
  const vec2 max_px = vec2((tile + 1u) * TILE_PX);
  if (TEST == TEST_CONE || TEST == TEST_CONE_APPROXIMATE) {
    const TileCone cone = tile_cone(frame, min_px, max_px, TEST == TEST_CONE_APPROXIMATE);
    frusta[index] = vec4(cone.axis, cone.slope);
    return;
  }
  const TilePlanes planes = tile_planes(frame, min_px, max_px);
  for (uint i = 0u; i < 4u; ++i) frusta[index * 4u + i] = planes.planes[i];
}
