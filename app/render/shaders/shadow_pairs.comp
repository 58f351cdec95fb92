// Of pairs of pixel and light: the light that would arrive without shadows, what the look-up leaves of it, and whether the
// light's radial bound lets it reach the pixel, and its mesh holds it.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, std430) readonly buffer PairBuffer { uvec2 pairs[]; };  // pixel, row by row; light
layout(set = 0, binding = 8, std430) writeonly buffer AnswerBuffer { vec4 answers[]; };  // z: 1 if it does; w: 1 if it holds it
layout(push_constant) uniform Push { uint count; };
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"
#define RADIAL_BINDING 9
#include "common/radial_bounds.glsl"
#define MESH_BINDING 10
#include "common/light_mesh_holds.glsl"

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

bool radial_reaches_point(uint light, vec3 position) {
  if (radial_bounds[light].kind == RADIAL_NONE) return true;
  vec3 rel = position - radial_bounds[light].position;
  if (radial_bounds[light].kind == RADIAL_SPOT) {
    const vec3 x = radial_bounds[light].axis_x;
    const vec3 z = radial_bounds[light].axis_z;
    rel = transpose(mat3(x, cross(z, x), z)) * rel;
  }
  const float slack = 4.0 * ROUND_POSITION * (length(position) + length(radial_bounds[light].position));
  return radial_reaches_box(light, rel - slack, rel + slack);
}

// But for rounding of the position.
bool mesh_may_hold(uint light, vec3 position) {
  if (light >= uint(meshes.length()) || meshes[light].kind == MESH_NONE) return true;
  const vec3 rel = position - meshes[light].position;
  const float slack = 4.0 * ROUND_POSITION * (length(position) + length(meshes[light].position));
  return mesh_holds(light, meshes[light].position + rel * max(1.0 - slack / max(length(rel), 1e-9), 0.0));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const uvec2 pixel = uvec2(pairs[i].x % frame.size_px.x, pairs[i].x / frame.size_px.x);
  const uint light = pairs[i].y;
  shadow_seed = seed_of_pixel(pixel);
  const Surface s = read_surface(ivec2(pixel), z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x));
  const Emitter e = emitter_at(light);
  vec3 sum = vec3(0.0);
  Way way;
  if (way_to(reflector(s), e.position, e.inverse_range2, way)) add_light_along(sum, reflector(s), way, e, is_spot(e));
  answers[i] = vec4(dot(sum, LUMINANCE), shadow_of(light, s.position, s.normal, shadow_seed),
                    radial_reaches_point(light, s.position) ? 1.0 : 0.0, mesh_may_hold(light, s.position) ? 1.0 : 0.0);
}
