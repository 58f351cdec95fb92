// Writes the depth bounds of every tile: what common/tile_depth.glsl finds.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform DepthImage depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer BoundsBuffer { uvec2 depth_bounds[]; };  // bits: nearest, farthest

#include "common/tile_depth.glsl"

void main() {
  const TileDepth depth = tile_depth(frame, depth_image, gl_WorkGroupID.xy);
  if (gl_LocalInvocationIndex == 0u)
    depth_bounds[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] =
        uvec2(depth_key(frame, depth.nearest), depth_key(frame, depth.farthest));
}
