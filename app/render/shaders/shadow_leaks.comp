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

// Where a pixel's rays begin.
struct RayStart {
  vec3 position;
  float off;  // how far 32 bits may have it off its triangle, m
};

float largest_coordinate(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Where the eye's ray meets the pixel's triangle, for depth is rounded; the depth's own place if there is none so near.
RayStart start_of(Reflector r, float z_view) {
  const vec3 to_eye = 2.0 * r.half_eye;
  const float window = asked.off.x * abs(z_view) + asked.off.y * largest_coordinate(r.position);
  const MirrorRay ray = MirrorRay(r.position + window * to_eye, -to_eye);
  const MirrorHit hit = walk_bvh(ray, asked.root, 2.0 * window, /*any*/ false);
  if (hit.triangle == MIRROR_SKY) return RayStart(r.position, 0.0);
  const BvhTriangle t = bvh_triangles[hit.triangle];
  const BvhInstance instance = bvh_instances[hit.instance];
  const vec3 ab = to_world(instance, t.b - t.a);
  const vec3 ac = to_world(instance, t.c - t.a);
  const vec3 weights = all_weights(vec2(hit.u, hit.v));
  const vec3 position = to_world(instance, t.a) + instance.origin + ab * weights.y + ac * weights.z;
  return RayStart(position, asked.off.y * max(largest_coordinate(ab), largest_coordinate(ac)));
}

// How many of the two rays to the light are stopped: none, the longer one alone, or both. The shorter lies in it.
uint stopped_rays(RayStart start, vec3 light) {
  const vec3 offset = light - start.position;
  const float length_m = length(offset);
  const vec3 direction = offset / length_m;
  uint count = 0u;
  for (; count < 2u; ++count) {
    const float end_m = min(asked.ends_m[count], asked.end_shares[count] * length_m) + start.off;
    if (!(end_m < 0.5 * length_m)) break;
    if (!is_stopped(MirrorRay(start.position + end_m * direction, direction), asked.root, length_m - 2.0 * end_m)) break;
  }
  return count;
}

void add_leak(inout ShadowLeak sum, Reflector r, RayStart start, uint light) {
  Way way;
  const Emitter e = emitter_at(light);
  const float whole = unshadowed_luminance(r, e, way);
  if (!(whole > 0.0)) return;
  const uint stopped = stopped_rays(start, e.position);
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
    const RayStart start = start_of(r, z_view);
    shadow_seed = seed_of_pixel(pixel);
    uint light;
    LOOKUP_EACH_IN(light, pixel, z_view, asked.first_light, asked.end_light) add_leak(sum, r, start, light);
    sum.found = loops_ended(asked.two) ? LEAK_ENDED : LEAK_FOUND;
  }
  leaks[pixel.x + frame.size_px.x * (pixel.y - asked.first_row)] = sum;
}
