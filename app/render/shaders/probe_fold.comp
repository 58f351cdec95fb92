// Level 0 of a capture, with its border: the faces of the cube on an octahedral square.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "probe_atlas_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, std430) readonly buffer FaceBuffer { vec4 faces[]; };
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D atlas_image;
layout(set = 0, binding = 2, std430) buffer ClippedBuffer { uint clipped; };  // texels that were too bright
layout(push_constant, scalar) uniform Push { ProbePush push; };
#include "common/probe_fold.glsl"

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy) - int(PROBE_BORDER);
  if (any(greaterThan(texel, ivec2(PROBE_SIDE)))) return;
  const ivec2 folded = octahedron_texel(texel, int(PROBE_SIDE));
  float weight;
  vec4 mean = folded_faces(uvec2(folded), PROBE_SIDE, weight);
  if (folded == texel && any(greaterThan(mean.rgb, vec3(PROBE_BRIGHTEST)))) atomicAdd(clipped, 1u);
  mean.rgb = min(mean.rgb, vec3(PROBE_BRIGHTEST));
  imageStore(atlas_image, ivec2(push.origin_x, push.origin_y) + ivec2(probe_level_origin(0u)) + texel, mean);
}
