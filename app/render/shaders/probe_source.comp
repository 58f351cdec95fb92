// What rougher levels are filtered from: a smaller square, in full precision.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "probe_atlas_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, std430) readonly buffer FaceBuffer { vec4 faces[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer SourceBuffer { ProbeSource sources[]; };
#include "common/probe_fold.glsl"

void main() {
  const uvec2 texel = gl_GlobalInvocationID.xy;
  float weight;
  const vec4 mean = folded_faces(texel, PROBE_SOURCE_SIDE, weight);
  const vec2 place = (vec2(texel) + 0.5) * (2.0 / float(PROBE_SOURCE_SIDE)) - 1.0;
  sources[texel.y * PROBE_SOURCE_SIDE + texel.x] =
      ProbeSource(normalize(octahedron_point(place)), weight, mean.rgb);
}
