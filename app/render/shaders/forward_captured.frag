// Forward+ over a captured frame, which has no meshes: every fragment of the picture walks the lights of its cell for the
// surface that is stored at its pixel.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "scene_data.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 4, scalar) readonly buffer SurroundingsBuffer {
  Surroundings surroundings;
  DirectionalData directional_lights[];
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "common/deferred_surface.glsl"
#include "common/probes.glsl"
#include "common/shade_cell.glsl"
#include "common/surroundings.glsl"

layout(location = 0) out vec4 out_color;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const float depth = texelFetch(depth_image, pixel, 0).x;
  if (is_sky(frame, depth)) discard;
  shadow_seed = seed_of_pixel(uvec2(pixel));
  const float z_view = z_view_of(frame, depth);
  const Surface s = read_surface(pixel, z_view);
  const vec3 emission = texelFetch(emission_image, pixel, 0).rgb;
  const Reflector r = reflector(s);
  vec3 sum = PROBES == PROBES_OFF ? shade_surroundings(s, r, emission)
                                  : shade_surroundings(s, r, emission, light_of_probes(s, r, uvec2(pixel), z_view));
  add_cell(sum, r, uvec2(pixel), z_view);
  out_color = vec4(sum, 1.0);
}
