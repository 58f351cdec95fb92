// Whether a light surely reaches a pixel, in double precision: the oracle's answer, on the GPU.
// Based on: reach() of oracle/reference/reference.cpp; angles are compared by the sine of their difference instead of by
// an arc tangent. Positions are those of View::world_position.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SURELY_REACHES
#define LAMP_COMMON_SURELY_REACHES
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"
#include "common/mixed.glsl"
#include "lamplight/shared/light.h"
#include "reach_data.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 3, scalar) readonly buffer LimitBuffer { ReachLimits limits[]; };
layout(set = 0, binding = 4, scalar) readonly buffer ViewBuffer { dmat4 world_from_view; };

dvec3 exact_world_position(uvec2 pixel, float device_depth) {
  const mat4 m = frame.clip_from_view;
  const double depth = double(device_depth);
  precise const double z =
      (double(m[3][3]) * depth - double(m[3][2])) / (double(m[2][2]) - double(m[2][3]) * depth);
  precise const double w = double(m[2][3]) * z + double(m[3][3]);
  precise const dvec2 ndc = 2.0lf * (dvec2(pixel) + 0.5lf) / dvec2(frame.size_px) - 1.0lf;
  precise const double x = (ndc.x * w - double(m[2][0]) * z - double(m[3][0])) / double(m[0][0]);
  precise const double y = (ndc.y * w - double(m[2][1]) * z - double(m[3][1])) / double(m[1][1]);
  precise const dvec3 world = world_from_view[0].xyz * x + world_from_view[1].xyz * y + world_from_view[2].xyz * z +
                              world_from_view[3].xyz;
  return world;
}

const uint OUTSIDE = 0u;
const uint BOUNDARY = 1u;
const uint INSIDE = 2u;

uint reach_of_cone(uint light, dvec3 from_light) {
  if (!(lights[light].outer_angle > 0.0)) return OUTSIDE;
  if (from_light == dvec3(0.0lf)) return BOUNDARY;  // at the light's own position there is no angle
  const dvec3 direction = dvec3(lights[light].direction);
  precise const double ahead = dot(direction, from_light);
  precise const double across = length(cross(direction, from_light));
  if (limits[light].near_sin * ahead > limits[light].near_cos * across) return INSIDE;
  return limits[light].far_sin * ahead < limits[light].far_cos * across ? OUTSIDE : BOUNDARY;
}

uint reach(uint light, dvec3 position) {
  precise const dvec3 from_light = position - dvec3(lights[light].position);
  precise const double distance_squared = dot(from_light, from_light);
  if (!(lights[light].range > 0.0) || distance_squared > limits[light].far_squared) return OUTSIDE;
  const uint by_range = distance_squared < limits[light].near_squared ? INSIDE : BOUNDARY;
  if (lights[light].type == LIGHT_POINT) return by_range;
  const uint by_cone = reach_of_cone(light, from_light);
  return by_range == INSIDE || by_cone == OUTSIDE ? by_cone : BOUNDARY;
}

bool surely_reaches(uint light, dvec3 position) { return reach(light, position) == INSIDE; }

uvec2 hash_of(uint light) { return uvec2(mixed(light + 1u), mixed(light ^ 0x9e3779b9u)); }
#endif
