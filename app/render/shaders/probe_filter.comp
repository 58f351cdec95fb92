// A rough level of a capture, with its border: for each direction the mean of all radiance, weighted by GGX as seen along
// the normal. An exact sum over all texels of the source: it has no noise and the same bits in every run, and a source of
// 64 x 64 texels is small. Weights are divided by their sum, so that a constant stays what it is.
// Based on: Karis, Real Shading in Unreal Engine 4, SIGGRAPH course (2013): the first half of the split sum.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/probe_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) readonly buffer SourceBuffer { ProbeSource sources[]; };
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D atlas_image;
layout(push_constant, scalar) uniform Push { ProbePush push; };

// Trowbridge-Reitz in the half vector, times the cosine of the light, up to a factor. Seen along the normal, twice the
// squared cosine of the half vector is 1 + n.l.
float lobe(float n_l, float a2) {
  const float d = 0.5 * ((1.0 - n_l) + a2 * (1.0 + n_l));
  return max(n_l, 0.0) / (d * d);
}

void main() {
  const uint side = probe_level_side(push.level);
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy) - int(PROBE_BORDER);
  if (any(greaterThan(texel, ivec2(side)))) return;
  const vec2 place = (vec2(octahedron_texel(texel, int(side))) + 0.5) * (2.0 / float(side)) - 1.0;
  const vec3 normal = normalize(octahedron_point(place));
  const float roughness = PROBE_SHARP + PROBE_STEP * float(push.level);
  const float a2 = roughness * roughness * roughness * roughness;
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (uint i = 0u; i < PROBE_SOURCE_SIDE * PROBE_SOURCE_SIDE; ++i) {
    const ProbeSource source = sources[i];
    const float weight = source.weight * lobe(dot(normal, source.direction), a2);
    sum += weight * source.radiance;
    weights += weight;
  }
  const vec3 mean = min(sum / weights, vec3(PROBE_BRIGHTEST));
  imageStore(atlas_image, ivec2(push.origin_x, push.origin_y) + ivec2(probe_level_origin(push.level)) + texel, vec4(mean, 0.0));
}
