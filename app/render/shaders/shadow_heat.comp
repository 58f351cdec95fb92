// Of the lights that reach each pixel, the shadow map that is worst off: the oldest or the smallest, one that waits, or
// none.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"
#include "shadow_heat_data.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) readonly buffer MapBuffer { uint maps[]; };  // frames or texels of each light's
layout(set = 0, binding = 3, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer WorstBuffer { uint worst_maps[]; };
layout(push_constant) uniform Push {
  uint end_light;
  uint largest_is_worst;  // else the smallest
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

bool reaches(Light light, vec3 position) {
  const vec3 from_light = position - light.position;
  const float d = length(from_light);
  if (!(d < light.range)) return false;
  return light.type == LIGHT_POINT || dot(from_light, light.direction) > light.cos_outer * d;
}

uint worse(uint a, uint b) {
  const bool by_size = largest_is_worst == 0u && max(a, b) < WAITS_FOR_REDRAWING && min(a, b) != 0u;
  return by_size ? min(a, b) : max(a, b);
}

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  uint worst = SKY_CELL;
  if (!is_sky(frame, depth)) {
    const float z_view = z_view_of(frame, depth);
    const vec3 position = world_position(frame, vec2(pixel) + 0.5, z_view);
    worst = 0u;
    uint light;
    LOOKUP_EACH_IN(light, pixel, z_view, 0u, end_light)
      if (reaches(lights[light], position)) worst = worse(worst, maps[light]);
  }
  worst_maps[pixel.x + frame.size_px.x * pixel.y] = worst;
}
