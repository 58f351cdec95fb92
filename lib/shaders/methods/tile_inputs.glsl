// What a shader that culls tiles reads and how it is specialised: the axes of tiled culling.
// Needs: TILE_CONSTANT and TILE_BINDING, where its constants and bindings begin; TILE_FRAME, how the frame is bound.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_TILE_INPUTS
#define LAMP_METHODS_TILE_INPUTS
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#include "lamplight/shared/light.h"
#include "lamplight/shared/tile.h"

layout(constant_id = TILE_CONSTANT + 0) const uint TILE_PX = 16;
layout(constant_id = TILE_CONSTANT + 1) const uint CAPACITY = 512;  // entries a list in shared memory has room for
layout(constant_id = TILE_CONSTANT + 2) const uint BOUNDS = 0;
layout(constant_id = TILE_CONSTANT + 3) const uint TEST = 0;
layout(constant_id = TILE_CONSTANT + 4) const uint SPOT = 0;
layout(constant_id = TILE_CONSTANT + 5) const uint ORDER = 0;
layout(constant_id = TILE_CONSTANT + 6) const bool PRUNE = false;
layout(constant_id = TILE_CONSTANT + 7) const bool AOS = false;            // bounds made from the light records here
layout(constant_id = TILE_CONSTANT + 8) const bool CACHED_FRUSTA = false;  // read from cull_frusta
layout(constant_id = TILE_CONSTANT + 9) const bool OWN_DEPTH_PASS = false; // read from cull_ranges
layout(constant_id = TILE_CONSTANT + 10) const uint LIST_ENTRIES = 512;    // CAPACITY times the number of ranges
layout(constant_id = TILE_CONSTANT + 11) const uint RANGES = 1;            // depth ranges a tile: 2 for the halves
layout(constant_id = TILE_CONSTANT + 12) const uint FURTHER = 0;           // FURTHER_*

layout(set = 0, binding = TILE_BINDING + 0, scalar) TILE_FRAME CullFrame { Frame cull_frame; };
layout(set = 0, binding = TILE_BINDING + 1) uniform DepthImage cull_depth;
layout(set = 0, binding = TILE_BINDING + 2, scalar) readonly buffer CullLights { Light cull_lights[]; };
layout(set = 0, binding = TILE_BINDING + 3, scalar) readonly buffer CullBounds { LightBounds cull_bounds[]; };
layout(set = 0, binding = TILE_BINDING + 4, scalar) readonly buffer CullFrusta { vec4 cull_frusta[]; };
layout(set = 0, binding = TILE_BINDING + 5, scalar) readonly buffer CullRanges { TileRanges cull_ranges[]; };
#define RADIAL_BINDING (TILE_BINDING + 6)
#define RECORD_OF(id) cull_lights[id]
#include "common/sphere_tests.glsl"
#include "common/further_tests_in_parts.glsl"
#include "common/spot_tests.glsl"

uint tile_index(uvec2 tile) {
  return tile.x + squares_across(cull_frame, TILE_PX).x * tile.y;
}

// The tile's sides: kept from an earlier frame of the same projection, or made here.
TileSides tile_sides(uvec2 tile) {
  const vec2 min_px = vec2(tile * TILE_PX);
  const vec2 max_px = vec2((tile + 1u) * TILE_PX);
  const bool cone = TEST == TEST_CONE || TEST == TEST_CONE_APPROXIMATE;
  TileSides sides;
  tile_edges(cull_frame, min_px, max_px, sides.x_edges, sides.y_edges);
  if (cone) sides.eye = cone_tip(cull_frame);
  if (!CACHED_FRUSTA) {
    sides.planes = tile_planes(cull_frame, min_px, max_px);
    if (cone) sides.cone = tile_cone(cull_frame, min_px, max_px, TEST == TEST_CONE_APPROXIMATE);
  } else if (cone) {
    const vec4 stored = cull_frusta[tile_index(tile)];
    sides.cone = TileCone(stored.xyz, stored.w);
    sides.planes = tile_planes(cull_frame, min_px, max_px);  // only cone-planes reads them
  } else {
    for (uint i = 0u; i < 4u; ++i) sides.planes.planes[i] = cull_frusta[tile_index(tile) * 4u + i];
  }
  return sides;
}

// For all threads of the group together.
TileRanges ranges_of(uvec2 tile) {
  if (OWN_DEPTH_PASS) return cull_ranges[tile_index(tile)];
  return tile_ranges(cull_frame, cull_depth, tile);
}

// A tile as lights are tested against it: made once, before the loop over the lights.
struct TileTarget {
  TileSides sides;
  TileRanges ranges;
  TileBox boxes[2];  // of the ranges
};

TileTarget tile_target(uvec2 tile, TileRanges ranges) {
  TileTarget target;
  target.sides = tile_sides(tile);
  target.ranges = ranges;
  for (uint range = 0u; range < 2u; ++range)
    target.boxes[range] = tile_box(target.sides, ranges.z_near[range], ranges.z_far[range]);
  return target;
}

// The part of the test that all ranges share.
bool touches_any_range(LightBounds sphere, TileTarget target) {
  const float z_far = max(target.ranges.z_far[0], target.ranges.z_far[1]);
  return sphere_touches_depths(sphere, target.ranges.z_near[0], z_far) &&
         sphere_touches_tile_sides(sphere, target.sides);
}

// The further tests of a range. `parts`: of a mask, those in reach.
bool passes_in_range(uint light, LightBounds sphere, TileTarget target, uint range, uint parts) {
  if (FURTHER == 0u) return true;
  const vec2 depths = vec2(target.ranges.z_near[range], target.ranges.z_far[range]);
  const vec4 x_edges = target.sides.x_edges;
  const vec4 y_edges = target.sides.y_edges;
  if (BOUNDS != BOUNDS_MASK) return passes_further_tests(cull_frame, light, sphere, x_edges, y_edges, depths);
  return passes_further_tests_in_parts(cull_frame, light, sphere, x_edges, y_edges,
                                       depths_of_parts(depths.x, mask_step(depths.x, depths.y), parts),
                                       depths.x, mask_scale(depths.x, depths.y), parts);
}

// Whether a light that passed it may reach the pixels of one of the tile's ranges.
bool touches_range(uint light, LightBounds sphere, TileTarget target, uint range) {
  const float z_near = target.ranges.z_near[range];
  const float z_far = target.ranges.z_far[range];
  uint parts = ~0u;
  if (BOUNDS == BOUNDS_MASK) {
    parts = parts_near(sphere, target.ranges);
    if (!sphere_touches_runs(sphere, target.sides, target.ranges, parts)) return false;
  } else if (!sphere_touches_tile_depths(sphere, target.sides, target.boxes[range], z_near, z_far)) {
    return false;
  }
  if (!passes_in_range(light, sphere, target, range, parts)) return false;
  if (SPOT == SPOT_SPHERE || cull_lights[light].type != LIGHT_SPOT) return true;
  return spot_touches_tile(cull_frame, cull_lights[light], target.sides, z_near, z_far, parts);
}

// Pixels of a tile with two ranges belong to one of them.
uint range_of_depth(float z_view, TileRanges ranges) { return RANGES == 2u && z_view > ranges.split ? 1u : 0u; }

LightBounds bounds_of(uint light) {
  if (AOS) return light_bounds(cull_frame, cull_lights[light]);
  return cull_bounds[light];
}

#endif
