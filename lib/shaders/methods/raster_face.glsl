// A fragment of a light's proxy: which light, and how deep the face lies around the raster pixel.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Triangle Conservative
// Depth".
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_RASTER_FACE
#define LAMP_METHODS_RASTER_FACE
#include "common/frame.glsl"
#include "common/light_proxy.glsl"
#include "methods/raster_inputs.glsl"

layout(location = 0) flat in uint in_light;
layout(location = 1) in float in_z_view;

const float FARTHEST_M = 1e18;

// Least and greatest depth of the face's plane up to `reach` raster pixels away in x and y. Over the screen, 1 / w is linear
// (perspective), or depth is. Uses derivatives: for all threads of the quad together. Where a thin triangle's corners are
// snapped coarsely its plane says nothing: then those of the whole light.
vec2 face_depths(float reach) {
  if (!FACE_DEPTHS) return vec2(proxies[in_light].z_near, proxies[in_light].z_far);
  const mat4 m = frame.clip_from_view;
  const float inverse_w = gl_FragCoord.w;
  const float change_w = reach * (abs(dFdx(inverse_w)) + abs(dFdy(inverse_w)));
  const float change_z = reach * (abs(dFdx(in_z_view)) + abs(dFdy(in_z_view)));
  if (m[2][3] == 0.0) return in_z_view + vec2(-change_z, change_z);
  const float nearest_w = 1.0 / (inverse_w + change_w);
  const float farthest_w = inverse_w > change_w ? 1.0 / (inverse_w - change_w) : FARTHEST_M;
  return (m[3][3] - vec2(nearest_w, farthest_w)) / m[2][3];
}

bool reaches_everywhere() { return lights[in_light].range > EVERYWHERE_M; }

#endif
