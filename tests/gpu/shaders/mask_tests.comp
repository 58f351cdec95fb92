// One thread a case: a sphere against the occupied parts of a tile's mask, by a first look and exactly.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/light.h"
#include "mask_case.h"

layout(local_size_x = 64) in;
const uint TILE_PX = 16;
const uint BOUNDS = 3;  // mask
const uint TEST = 5;    // exact
#include "common/light_bounds.glsl"
#include "common/sphere_tests.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frames[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CaseBuffer { MaskCase cases[]; };
layout(set = 0, binding = 2, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer AnswerBuffer { MaskAnswer answers[]; };

// Of a depth, rounded to a few steps less and a few more.
uint parts_apart(float z, float z_near, float scale) {
  const int ROUNDED = 4;
  const uint a = mask_part(intBitsToFloat(floatBitsToInt(z) - ROUNDED), z_near, scale);
  const uint b = mask_part(intBitsToFloat(floatBitsToInt(z) + ROUNDED), z_near, scale);
  return max(a, b) - min(a, b);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const MaskCase c = cases[i];
  const Frame frame = frames[c.volume.frame];
  const LightBounds sphere = light_bounds(frame, lights[i]);
  const float z_near = z_view_of(frame, c.volume.nearest);
  const float z_far = z_view_of(frame, c.volume.farthest);
  const float scale = mask_scale(z_near, z_far);
  const float step = mask_step(z_near, z_far);
  const float z = z_view_of(frame, c.depth);
  const uint own = mask_part(z, z_near, scale);
  const uint parts = parts_near(sphere, z_near, scale, c.others | 1u << own);
  TileSides sides;
  tile_edges(frame, c.volume.min_px, c.volume.max_px, sides.x_edges, sides.y_edges);
  answers[i] = MaskAnswer(look_at_parts(sphere, sides, z_near, step, scale, parts),
                          sphere_touches_parts(sphere, sides, z_near, step, parts) ? 1u : 0u,
                          max(parts_apart(z, z_near, scale), parts_apart(z_near, z_near, mask_scale(z_near, z_near))));
}
