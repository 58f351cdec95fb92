// For each pixel: of the lights of its list, what light a ray says arrives, what it says is stopped, and where the
// shadow filter says otherwise.
// Promise: the definitions of shadow_truth.h; light, filter and look-up are shading's own.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"
#include "shadow_leak_data.h"
#define BVH_THREADS 64u
#define BVH_FIRST_BINDING 32

layout(local_size_x_id = 0, local_size_y_id = 1) in;  // BVH_THREADS
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, scalar) writeonly buffer LeakBuffer { ShadowLeak leaks[]; };
layout(push_constant, scalar) uniform Push { ShadowLeakAsked asked; };
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"
#include "common/unshadowed.glsl"
#include "common/bvh_scene.glsl"
#include "common/loops_ended.glsl"
#include "common/mirror.glsl"
#include "common/bvh_walk.glsl"

// How many of the two rays to the light are stopped: none, the longer one alone, or both. The shorter lies in it.
uint stopped_rays(vec3 from, vec3 offset) {
  const float length_m = length(offset);
  const vec3 direction = offset / length_m;
  uint count = 0u;
  for (; count < 2u; ++count) {
    const float end_m = asked.ends_m[count];
    if (!(end_m < 0.5 * length_m)) break;
    if (!is_stopped(MirrorRay(from + end_m * direction, direction), asked.root, length_m - 2.0 * end_m)) break;
  }
  return count;
}

void add_leak(inout ShadowLeak sum, Reflector r, uint light) {
  Way way;
  const float whole = unshadowed_luminance(r, emitter_at(light), way);
  if (!(whole > 0.0)) return;
  const uint stopped = stopped_rays(r.position, way.offset);
  if (stopped == 1u) {
    ++sum.unclear;
    return;
  }
  const float share = shadow_of(light, r.position, r.normal, shadow_seed);
  if (stopped == 0u) {
    sum.arriving += whole;
    sum.lost += whole * (1.0 - share);
  } else {
    sum.stopped += whole;
    sum.leaked += whole * share;
  }
}

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, asked.first_row);
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  ShadowLeak sum = ShadowLeak(0.0, 0.0, 0.0, 0.0, 0u, LEAK_SKY);
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (!is_sky(frame, depth)) {
    const float z_view = z_view_of(frame, depth);
    const Reflector r = reflector(read_surface(ivec2(pixel), z_view));
    shadow_seed = seed_of_pixel(pixel);
    uint light;
    LOOKUP_EACH_IN(light, pixel, z_view, asked.first_light, asked.end_light) add_leak(sum, r, light);
    sum.found = loops_ended(asked.two) ? LEAK_ENDED : LEAK_FOUND;
  }
  leaks[pixel.x + frame.size_px.x * (pixel.y - asked.first_row)] = sum;
}
