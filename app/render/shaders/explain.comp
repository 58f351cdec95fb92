// Why a light is in a cell: every test of the library that culls with, one by one, against the smallest tile and depths
// that hold the cell's pixels. A thread a light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#define TILE_PX 16u  // of functions that are not called
#define BOUNDS BOUNDS_MASK
#define TEST TEST_EXACT
#define SPOT SPOT_CONE_SEGMENTS
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "explain_data.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, std430) readonly buffer IdBuffer { uint ids[]; };
layout(set = 0, binding = 3, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer ExplainedBuffer { Explained explained[]; };
layout(push_constant, scalar) uniform Push { ExplainedCell cell; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cell.count) return;
  const Light light = lights[ids[i]];
  const LightBounds sphere = light_bounds(frame, light);
  TileSides sides;
  sides.planes = tile_planes(frame, cell.min_px, cell.max_px);
  tile_edges(frame, cell.min_px, cell.max_px, sides.x_edges, sides.y_edges);
  const TileBox box = tile_box(sides, cell.z_near, cell.z_far);
  const float scale = mask_scale(cell.z_near, cell.z_far);
  uint passed = 0u;
  if (sphere_touches_sides(sphere, sides.planes.planes)) passed |= PASSES_SIDES;
  if (sphere_touches_depths(sphere, cell.z_near, cell.z_far)) passed |= PASSES_DEPTHS;
  if (parts_near(sphere, cell.z_near, scale, cell.mask) != 0u) passed |= PASSES_MASK;
  if (sphere_touches_box(sphere, box.low, box.high)) passed |= PASSES_BOX;
  if (sphere_touches_frustum(sphere, sides, cell.z_near, cell.z_far)) passed |= PASSES_EXACT;
  const bool spot = light.type == LIGHT_SPOT;
  if (!spot || spot_touches_tile(frame, light, sides, cell.z_near, cell.z_far, cell.mask)) passed |= PASSES_CONE;
  const bool beside = (passed & PASSES_DEPTHS) != 0u;
  explained[i] = Explained(passed, beside ? parts_near(sphere, cell.z_near, scale, ~0u) : 0u);
}
