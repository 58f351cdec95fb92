// What a capture says of all directions, as a picture: turning to the right along x (-z in the middle), up along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/probe_atlas.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, std430) writeonly buffer PictureBuffer { vec4 picture[]; };
layout(push_constant, scalar) uniform Push { ProbePanorama push; };

void main() {
  const uvec2 size = uvec2(2u, 1u) * push.height;
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, size))) return;
  const vec2 angles = ((vec2(pixel) + 0.5) / float(push.height) - vec2(1.0, 0.5)) * PI;
  const vec3 direction = vec3(cos(angles.y) * sin(angles.x), -sin(angles.y), -cos(angles.y) * cos(angles.x));
  const float covered = probe_distance(push.slot, direction) < PROBE_SKY_M ? 1.0 : 0.0;
  picture[pixel.y * size.x + pixel.x] = vec4(probe_radiance(push.slot, direction, push.roughness), covered);
}
