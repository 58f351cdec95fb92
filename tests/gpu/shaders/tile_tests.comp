// One thread a case: the tile's sphere test and spot test, as specialised.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/light.h"
#include "volume_case.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint TEST = 0;
layout(constant_id = 1) const uint SPOT = 0;
const uint TILE_PX = 16;
const uint BOUNDS = 3;  // mask: every kind of spot test is at hand
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frames[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CaseBuffer { VolumeCase cases[]; };
layout(set = 0, binding = 2, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer AnswerBuffer { uint answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const VolumeCase c = cases[i];
  const Frame frame = frames[c.frame];
  const LightBounds sphere = light_bounds(frame, lights[i]);
  const float z_near = z_view_of(frame, c.nearest);
  const float z_far = z_view_of(frame, c.farthest);
  TileSides sides;
  tile_edges(frame, c.min_px, c.max_px, sides.x_edges, sides.y_edges);
  sides.planes = tile_planes(frame, c.min_px, c.max_px);
  sides.eye = cone_tip(frame);
  sides.cone = tile_cone(frame, c.min_px, c.max_px, TEST == TEST_CONE_APPROXIMATE);
  const TileBox box = tile_box(sides, z_near, z_far);

  uint touches = 0u;
  if (sphere_touches_tile_sides(sphere, sides) && sphere_touches_tile_depths(sphere, sides, box, z_near, z_far))
    touches |= 1u;
  if (lights[i].type != LIGHT_SPOT || spot_touches_tile(frame, lights[i], sides, z_near, z_far, ~0u)) touches |= 2u;
  answers[i] = touches;
}
