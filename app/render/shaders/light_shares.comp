// What each of some lights adds to a pixel, and what its surroundings add, reflection probes among them: the terms of
// deferred.comp's sum, one by one.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "scene_data.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, std430) readonly buffer IdBuffer { uint ids[]; };
layout(set = 0, binding = 4, scalar) readonly buffer SurroundingsBuffer {
  Surroundings surroundings;
  DirectionalData directional_lights[];
};
layout(set = 0, binding = 8, std430) writeonly buffer TermBuffer {
  vec4 terms[];  // one more than lights: surroundings, and in w what a mirror ray leaves of the reflection to probes
};
layout(push_constant) uniform Push {
  uvec2 pixel;
  uint count;        // of lights in ids,
  uint probe_count;  // and of probes behind them, in the order that shading takes them in
};
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"
#include "common/probe_light.glsl"
#include "common/surroundings.glsl"

ProbeSum light_of_probes(Surface s, Reflector r) {
  ProbeSum sum = ProbeSum(vec3(0.0), 0.0);
  const ProbeAsker asker = probe_asker(s, r);
  for (uint i = 0u; i < probe_count && sum.weight < 1.0; ++i) add_probe(sum, asker, probes[ids[count + i]]);
  leave_to_mirror(sum, left_by_mirror(s));
  return sum;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i > count) return;
  shadow_seed = seed_of_pixel(pixel);
  const Surface s = read_surface(ivec2(pixel), z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x));
  const Reflector r = reflector(s);
  vec3 term = vec3(0.0);
  if (i < count) {
    add_light(term, r, ids[i]);
  } else {
    const vec3 emission = texelFetch(emission_image, ivec2(pixel), 0).rgb;
    term = PROBES == PROBES_OFF ? shade_surroundings(s, r, emission)
                                : shade_surroundings(s, r, emission, light_of_probes(s, r));
  }
  terms[i] = vec4(term, i == count ? left_by_mirror(s) : 0.0);
}
