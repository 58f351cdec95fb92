// The engine's lighting: walks the lights of each pixel. A renderer would shade here; this one counts those that reach.
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D depth_image;
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer CountBuffer { uvec2 counts[]; };  // reached, walked

bool reaches(Light light, vec3 position) {
  const vec3 to_position = position - light.position;
  const float distance_m = length(to_position);
  if (distance_m >= light.range) return false;
  return light.type == LIGHT_POINT || dot(to_position, light.direction) > light.cos_outer * distance_m;
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  const uvec2 size_px = lookup_frame.size_px;
  if (any(greaterThanEqual(pixel, size_px))) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  uvec2 count = uvec2(0u);
  if (depth > 0.0) {
    const float z_view = z_view_of(lookup_frame, depth);
    const vec3 position = world_position(lookup_frame, vec2(pixel) + 0.5, z_view);
    uint light;
    for (Walk walk = walk_begin(pixel, z_view); walk_next(walk, light);) {
      count.y += 1u;
      if (reaches(lights[light], position)) count.x += 1u;
    }
  }
  counts[pixel.x + size_px.x * pixel.y] = count;
}
