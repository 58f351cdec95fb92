// What both shading passes of an eye have in common: its surfaces, the lights, the picture.
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_samplerless_texture_functions : require
#include "lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D surface_and_depth[2];
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { HostLight lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer PictureBuffer { vec4 picture[]; };
layout(push_constant, scalar) uniform Push {
  mat4 world_from_clip;
  uvec2 size_px;
  uint light_count;
  uint eye;
};

vec3 position_of(uvec2 pixel, float depth) {
  const vec2 ndc = (vec2(pixel) + 0.5) / vec2(size_px) * 2.0 - 1.0;
  const vec4 position = world_from_clip * vec4(ndc, depth, 1.0);
  return position.xyz / position.w;
}
