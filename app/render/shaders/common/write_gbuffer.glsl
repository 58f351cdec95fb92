// Writes a fragment's surface into the G-buffer.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_WRITE_GBUFFER
#define LAMP_WRITE_GBUFFER
#include "common/gbuffer.glsl"
#include "common/material.glsl"

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec2 out_surface;
layout(location = 2) out vec4 out_emission;

void write_gbuffer() {
  const vec4 color = material_color();
  const vec3 normal = material_normal(gl_FrontFacing);
  const vec3 factors = material_factors();
  const vec3 emission = material_emission();
  if (is_cut_out(color.a)) discard;
  out_base_color = vec4(color.rgb, 1.0);
  out_surface = pack_surface(normal, factors.x, factors.y, factors.z);
  out_emission = vec4(emission, 1.0);
}

#endif
