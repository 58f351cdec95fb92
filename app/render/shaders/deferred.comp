// Deferred shading in compute: each pixel reads the G-buffer once and walks the lights of its cell, the sum in registers.
// With a fused look-up the same dispatch culls first.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.3; Andersson, Parallel Graphics in Frostbite
// (2009).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "scene_data.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(constant_id = 11) const bool WALK = true;  // false: only the surroundings; light volumes add the rest
layout(constant_id = 12) const uint FIRST_ROW = 0;  // of the picture that is shaded; not 0 only for a part of a reference
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 4, scalar) readonly buffer SurroundingsBuffer {
  Surroundings surroundings;
  DirectionalData directional_lights[];
};
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D hdr_image;
layout(set = 0, binding = 8) uniform utexture2D triangle_image;  // only where still lights are in lists of triangles
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "common/deferred_surface.glsl"
#include "common/probes.glsl"
#include "common/shade_group.glsl"
#include "common/shade_still.glsl"
#include "common/surroundings.glsl"

void main() {
  lookup_prepare();
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy + uvec2(0u, FIRST_ROW));
  shadow_seed = seed_of_pixel(uvec2(pixel));
  const bool inside = all(lessThan(uvec2(pixel), frame.size_px));
  const float depth = inside ? texelFetch(depth_image, pixel, 0).x : 0.0;
  const bool lit = inside && !is_sky(frame, depth);
  const float z_view = z_view_of(frame, depth);
  vec3 sum = surroundings.sky;
  Reflector r;
  if (lit) {
    const Surface s = read_surface(pixel, z_view);
    r = reflector(s);
    const vec3 emission = texelFetch(emission_image, pixel, 0).rgb;
    sum = PROBES == PROBES_OFF ? shade_surroundings(s, r, emission)
                               : shade_surroundings(s, r, emission, light_of_probes(s, r, uvec2(pixel), z_view));
  }
  if (WALK) add_group(sum, r, lit, uvec2(pixel), z_view);
  if (lit) add_still(sum, r, STILL_LISTS == STILL_TRIANGLES ? texelFetch(triangle_image, pixel, 0).x : 0u);
  if (inside) imageStore(hdr_image, pixel, vec4(sum, lit ? 1.0 : 0.0));  // alpha: where surfaces are
}
