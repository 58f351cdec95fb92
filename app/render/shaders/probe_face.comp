// Keeps a picture that was drawn from a probe as one face of its capture: radiance, and 1 over the distance.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"
#include "probe_atlas_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D hdr_image;
layout(set = 0, binding = 3, std430) writeonly buffer FaceBuffer { vec4 faces[]; };
layout(push_constant, scalar) uniform Push { ProbePush push; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  float inverse = 0.0;
  if (!is_sky(frame, depth)) {
    const vec2 centre = vec2(pixel) + 0.5;
    inverse = 1.0 / max(distance(world_position(frame, centre, z_view_of(frame, depth)), frame.eye_world), 1e-6);
  }
  faces[(push.level * PROBE_SIDE + pixel.y) * PROBE_SIDE + pixel.x] = vec4(imageLoad(hdr_image, ivec2(pixel)).rgb, inverse);
}
