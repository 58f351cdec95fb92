// Forward+: each fragment walks the lights of its cell. Also for transparent surfaces, at their own depth.
// Based on: Harada, McKee, Yang, Forward+: Bringing Deferred Lighting to the Next Level, Eurographics (2012).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "common/material.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 4, scalar) readonly buffer SurroundingsBuffer {
  Surroundings surroundings;
  DirectionalData directional_lights[];
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "common/decals.glsl"
#include "common/probes.glsl"
#include "common/shade_cell.glsl"
#include "common/shade_still.glsl"
#include "common/surroundings.glsl"
#include "common/eye.glsl"

layout(location = 5) flat in uint in_triangle;
layout(location = 0) out vec4 out_color;

void main() {
  const vec4 color = material_color();
  const vec3 normal = material_normal(gl_FrontFacing);
  const vec3 factors = material_factors();
  const vec3 emission = material_emission();
  if (is_cut_out(color.a)) discard;

  shadow_seed = seed_of_pixel(uvec2(gl_FragCoord.xy));
  const float z_view = z_view_of(frame, gl_FragCoord.z);
  const vec3 position = world_position(frame, gl_FragCoord.xy, z_view);
  Surface s = Surface(position, normal, to_eye(frame, position), color.rgb, factors.x, factors.y, factors.z);
  if (BOXES) apply_decals(s, uvec2(gl_FragCoord.xy), z_view);
  const Reflector r = reflector(s);
  vec3 sum = PROBES == PROBES_OFF ? shade_surroundings(s, r, emission)
                                  : shade_surroundings(s, r, emission, light_of_probes(s, r, uvec2(gl_FragCoord.xy), z_view));
  add_cell(sum, r, uvec2(gl_FragCoord.xy), z_view);
  add_still(sum, r, in_triangle);
  out_color = vec4(sum, max(color.a, material.least_alpha));
}
