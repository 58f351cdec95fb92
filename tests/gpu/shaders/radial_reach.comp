// How far a radial bound lets light reach towards points: whether it reaches a point, and a sphere that the point lies
// in, near its edge; spheres of four sizes.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define RADIAL_BINDING 2
#include "common/radial_bounds.glsl"
#include "shadow_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { ShadowCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer ReachBuffer { uint reached[]; };  // bit 0: the point, 1: the sphere

void main() {
  const uint i = gl_GlobalInvocationID.x;
  const uint light = cases[i].light;
  vec3 rel = cases[i].position - radial_bounds[light].position;
  if (radial_bounds[light].kind == RADIAL_SPOT) {
    const vec3 x = radial_bounds[light].axis_x;
    const vec3 z = radial_bounds[light].axis_z;
    rel = transpose(mat3(x, cross(z, x), z)) * rel;
  }
  const bool known = radial_bounds[light].kind != RADIAL_NONE;
  const bool point = !known || radial_reaches_sphere(light, rel, 2e-5);
  const vec3 aside = cases[i].normal * (0.02 * pow(4.0, float(i % 4u)));
  const bool sphere = !known || radial_reaches_sphere(light, rel + aside, 1.01 * length(aside) + 1e-3);
  reached[i] = uint(point) | uint(sphere) << 1u;
}
