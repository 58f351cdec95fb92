// The surfaces that mirror rays met, as a G-buffer of their own: with them in memory, whoever looks up lights shades the
// same bits.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
#include "common/deferred_surface.glsl"
#include "common/bvh_scene.glsl"
#include "common/mirror.glsl"
#include "common/bvh_surface.glsl"
layout(set = 0, binding = 2, scalar) readonly buffer HitBuffer { MirrorHit hits[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer SurfaceBuffer { MirrorSurface surfaces[]; };

// Radians that a pixel is high; of an orthographic view none.
float pixel_angle() {
  const mat4 m = frame.clip_from_view;
  return m[2][3] != 0.0 ? 2.0 / (abs(m[1][1]) * float(frame.size_px.y)) : 0.0;
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const uint number = pixel.y * frame.size_px.x + pixel.x;
  const MirrorHit hit = hits[number];
  if (hit.triangle >= MIRROR_ENDED) return;
  const float z_view = z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x);
  const MirrorRay ray = mirror_ray(read_surface(ivec2(pixel), z_view), z_view);
  // As if the eye were behind the mirror: the cone is as wide as on the mirror and more.
  const MirrorRay from_eye = MirrorRay(ray.origin - ray.direction * z_view, ray.direction);
  surfaces[number] = surface_at(hit, from_eye, pixel_angle());
}
