// What both pixel shaders have in common: the surface, whose material is one of an array of textures, and the lights.
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_nonuniform_qualifier : require
#include "lighting.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { HostLight lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer CountBuffer { uint light_count; };
layout(set = 0, binding = 0) uniform texture2D materials[];
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 0) out vec4 target;  // w: lights that were walked

vec3 textured_albedo() {
  const vec2 place = abs(normal.y) > 0.5 ? position.xz : vec2(position.x + position.z, position.y);
  return texelFetch(materials[nonuniformEXT(material)], ivec2(mod(place * 8.0, vec2(8.0))), 0).xyz;
}
