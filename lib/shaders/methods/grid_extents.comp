// The box around all lights of finite range: a work group for each block of them, and then the greatest of all groups.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "common/ordered_float.glsl"
#include "lamplight/shared/implicit_grid.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 2, scalar) buffer ExtentBuffer { uint extents[]; };

shared uint s_extents[GRID_EXTENT_WORDS];

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint first = gl_WorkGroupID.x * GRID_BLOCK;
  vec3 least = vec3(INFINITE_RADIUS);
  vec3 greatest = vec3(-INFINITE_RADIUS);
  bool any_light = false;
  for (uint light = first + thread; light < min(first + GRID_BLOCK, light_count_of(frame)); light += gl_WorkGroupSize.x) {
    const LightSphere sphere = spheres[light];
    if (!(sphere.radius >= 0.0 && sphere.radius < INFINITE_RADIUS)) continue;
    least = any_light ? min(least, sphere.center - sphere.radius) : sphere.center - sphere.radius;
    greatest = any_light ? max(greatest, sphere.center + sphere.radius) : sphere.center + sphere.radius;
    any_light = true;
  }
  if (thread < GRID_EXTENT_WORDS) s_extents[thread] = 0u;
  barrier();  // zeros before the greatest
  if (any_light)
    for (uint axis = 0u; axis < 3u; ++axis) {
      atomicMax(s_extents[axis], ~ordered_bits(least[axis]));
      atomicMax(s_extents[3u + axis], ordered_bits(greatest[axis]));
    }
  barrier();  // all of the group before its greatest is handed on
  if (thread < GRID_EXTENT_WORDS && s_extents[thread] != 0u) atomicMax(extents[thread], s_extents[thread]);
}
