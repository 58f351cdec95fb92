// The slices that each light reaches along each axis, in the order of the keys: those of its sphere, and of its cone.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/implicit_grid.glsl"
#include "common/world_slack.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint SLICES = 8;
layout(constant_id = 1) const uint LIGHTS = 1;  // capacity: from one axis' ranges to the next one's
layout(constant_id = 2) const bool SORTED = true;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 3, scalar) readonly buffer GridBuffer { ImplicitGrid grids[]; };
layout(set = 0, binding = 4, scalar) readonly buffer OrderBuffer { uint order[]; };  // with SORTED
layout(set = 0, binding = 5, scalar) writeonly buffer RangeBuffer { uint ranges[]; };

// How far a cone reaches along an axis, as a share of its range: to the rim, or all the way where the axis is in it.
float cone_reach(Light light, float toward, float aside) {
  return toward >= light.cos_outer ? 1.0 : max(toward * light.cos_outer + aside * light.sin_outer, 0.0);
}

vec3 cone_reach(Light light, vec3 toward) {
  const vec3 square = light.direction * light.direction;
  const vec3 aside = sqrt(square.yzx + square.zxy);  // not of 1 - toward²: narrow cones along an axis need it exact
  return vec3(cone_reach(light, toward.x, aside.x), cone_reach(light, toward.y, aside.y),
              cone_reach(light, toward.z, aside.z));
}

void main() {
  const uint at = gl_GlobalInvocationID.x;
  if (at >= light_count_of(frame)) return;
  const uint index = SORTED ? order[at] : at;
  const LightSphere sphere = spheres[index];
  const float radius = sphere.radius * (1.0 + ROUND_RADIUS) + world_slack(frame, sphere.center);
  vec3 low = sphere.center - radius;
  vec3 high = sphere.center + radius;
  if (lights[index].type == LIGHT_SPOT && sphere.radius < INFINITE_RADIUS) {
    const Light light = lights[index];
    const float slack = 2.0 * ROUND_RADIUS * light.range + world_slack(frame, light.position);
    low = max(low, light.position - light.range * cone_reach(light, -light.direction) - slack);
    high = min(high, light.position + light.range * cone_reach(light, light.direction) + slack);
  }
  const bool is_everywhere = sphere.radius >= INFINITE_RADIUS;
  const uvec3 first = grid_slices(grids[0], clamp(low, -LARGEST_FINITE, LARGEST_FINITE), SLICES);
  const uvec3 last = grid_slices(grids[0], clamp(high, -LARGEST_FINITE, LARGEST_FINITE), SLICES);
  for (uint axis = 0u; axis < 3u; ++axis) {
    uint range = first[axis] | last[axis] << GRID_LAST_SHIFT;
    if (is_everywhere) range = SLICES << GRID_LAST_SHIFT;  // what is no number included
    if (sphere.radius < 0.0) range = GRID_NO_SLICES;
    ranges[axis * LIGHTS + at] = range;
  }
}
