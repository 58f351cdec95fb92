// The same picture from all lights, to compare with; and two others: shadows by a ray from each pixel to each light
// against every box, which no map has a part in, and no shadows.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "house.glsl"
#include "surface.glsl"

layout(constant_id = 0) const uint SHADOWS = 0;  // 0 by maps, 1 by rays, 2 none
layout(push_constant, scalar) uniform Push {
  mat4 clip_from_world;
  uint light_count;
};

// Whether the way from `from` to `from + way` meets the box.
bool meets(Box box, vec3 from, vec3 way) {
  const vec3 a = (box.center - box.half_extent - from) / way;
  const vec3 b = (box.center + box.half_extent - from) / way;
  const vec3 enters = min(a, b);
  const vec3 leaves = max(a, b);
  return max(max(enters.x, enters.y), max(enters.z, 0.0)) < min(min(leaves.x, leaves.y), min(leaves.z, 1.0));
}

vec3 traced_light(uint light) {
  const vec3 arrives = light_on(lights[light], position, normal);
  if (arrives == vec3(0.0)) return vec3(0.0);
  const vec3 from = position + 0.002 * normal;
  for (uint box = 0u; box < HOUSE_BOXES; ++box)
    if (meets(house_box(box), from, lights[light].position - from)) return vec3(0.0);
  return arrives;
}

void main() {
  const vec3 albedo = albedo_of(material);
  target = vec4(0.0);
  for (uint light = 0u; light < light_count; ++light) {
    vec3 arrives;
    if (SHADOWS == 0u) arrives = shadowed_light(light);
    else if (SHADOWS == 1u) arrives = traced_light(light);
    else arrives = light_on(lights[light], position, normal);
    target += vec4(albedo * arrives, 1.0);
  }
}
