// A mirror ray for each pixel whose surface is smooth enough: what it meets first.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"
#define BVH_THREADS 64u
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
#include "common/deferred_surface.glsl"
#include "common/bvh_scene.glsl"
#include "common/loops_ended.glsl"
#include "common/mirror.glsl"
#include "common/bvh_walk.glsl"
layout(set = 0, binding = 2, scalar) writeonly buffer HitBuffer { MirrorHit hits[]; };
layout(set = 0, binding = 3, scalar) buffer CountBuffer { MirrorCounts counts; };
layout(push_constant, scalar) uniform Push { MirrorPush push; };

shared uint s_rays;
shared uint s_hits;
shared uint s_ended;

MirrorHit hit_of(ivec2 pixel) {
  const MirrorHit none = MirrorHit(MIRROR_NO_RAY, 0u, 0.0, 0.0);
  const float depth = texelFetch(depth_image, pixel, 0).x;
  if (is_sky(frame, depth)) return none;
  const float z_view = z_view_of(frame, depth);
  const Surface s = read_surface(pixel, z_view);
  if (!(mirror_weight_of(s, push.roughness) > 0.0)) return none;
  MirrorHit hit = first_hit(mirror_ray(s, z_view), push.root);
  if (loops_ended(push.two)) hit.triangle = MIRROR_ENDED;
  return hit;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    s_rays = 0u;
    s_hits = 0u;
    s_ended = 0u;
  }
  barrier();  // they are 0
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (all(lessThan(pixel, frame.size_px))) {
    const MirrorHit hit = hit_of(ivec2(pixel));
    hits[pixel.y * frame.size_px.x + pixel.x] = hit;
    if (hit.triangle != MIRROR_NO_RAY) atomicAdd(s_rays, 1u);
    if (hit.triangle < MIRROR_ENDED) atomicAdd(s_hits, 1u);
    if (hit.triangle == MIRROR_ENDED) atomicAdd(s_ended, 1u);
  }
  barrier();  // all have counted
  if (gl_LocalInvocationIndex != 0u || s_rays == 0u) return;
  atomicAdd(counts.rays, s_rays);
  atomicAdd(counts.hits, s_hits);
  if (s_ended != 0u) atomicAdd(counts.ended, s_ended);
}
