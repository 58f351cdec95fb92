// The mirror rays of all pixels, to be held against others.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "mirror_data.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, scalar) writeonly buffer RayBuffer { MirrorAsked rays[]; };
#include "common/deferred_surface.glsl"
#include "common/mirror.glsl"

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const float z_view = z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x);
  const MirrorRay ray = mirror_ray(read_surface(ivec2(pixel), z_view), z_view);
  rays[pixel.y * frame.size_px.x + pixel.x] = MirrorAsked(ray.origin, ray.direction);
}
