// As count_everywhere does, but the work group takes many lights at once; DIFFERENT where these are not, in their order,
// the lights that each thread meets by itself. Look-ups whose pixels have cells of their own are walked plainly.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) writeonly buffer CountBuffer { uint counts[]; };
#include "lookup.glsl"
#include "count_walked.glsl"

const uint DIFFERENT = ~0u;
const uint ROOM = 64u;
shared uint s_taken[ROOM];

#ifdef LOOKUP_TOGETHER
bool meets_taken(inout Walk own, uint count) {
  bool alike = count <= ROOM;
  for (uint i = 0u; i < min(count, ROOM); ++i) {
    uint light;
    const bool met = walk_next(own, light);
    alike = alike && met && light == s_taken[i];
  }
  return alike;
}

uint count_taken(uvec2 pixel, uint most) {
  Walk own = walk_begin(pixel, 1.0);
  Walk walk = own;
  uint lights = 0u;
  bool alike = true;
  bool over = false;
  for (;;) {
    uint light;
    const uint count = walk_take(walk, most, gl_LocalInvocationIndex, light);
    if (count == 0u) break;
    alike = alike && !over;
    over = count + 32u <= most;
    if (gl_LocalInvocationIndex < min(count, ROOM)) s_taken[gl_LocalInvocationIndex] = light;
    barrier();  // all are there
    alike = meets_taken(own, count) && count <= most && alike;
    lights += count;
    barrier();  // and read before others take their places
  }
  uint left;
  return alike && !walk_next(own, left) ? lights : DIFFERENT;
}
#endif

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  uint lights = count_walked(pixel);
#ifdef LOOKUP_TOGETHER
  if (LOOKUP_TOGETHER) {
    const uvec3 taken = uvec3(count_taken(pixel, 32u), count_taken(pixel, 33u), count_taken(pixel, ROOM));
    lights = any(equal(taken, uvec3(DIFFERENT))) || taken.x != taken.y ? DIFFERENT : taken.y + taken.z;
  }
#endif
  if (all(lessThan(pixel, frame.size_px))) counts[pixel.x + frame.size_px.x * pixel.y] = lights;
}
