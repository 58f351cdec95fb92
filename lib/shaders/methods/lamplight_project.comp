// A block of lights by one work group: bounds, rectangle of tiles, a first look at the depths; lights that remain are
// counted in the cells that they may reach.
// Promise: reads every light once; what later passes know of a light's place is what is stored here.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint CELLS = 1;
layout(constant_id = 4) const uint BLOCK = 256;  // lights
layout(constant_id = 5) const uint TWICE_THREADS = 512;
#define BOUNDS BOUNDS_MASK
#include "common/light_bounds.glsl"
#include "common/mask_tests.glsl"
#include "common/sphere_rectangle.glsl"
#include "common/tile_volume.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) readonly buffer CellDepthBuffer { uint cell_depths[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer ReachBuffer { LightReach reaches[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer SurvivorBuffer { uint survivors[]; };  // a block's from its first light's place
layout(set = 0, binding = 7, scalar) writeonly buffer SurvivorCountBuffer { uint survivor_counts[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer CountBuffer { uint counts[]; };  // [block][cell]

shared uint s_counts[CELLS];
shared uint s_kept_count;

#define VISIT_CELL(cell, light) atomicAdd(s_counts[cell], 1u)
#include "methods/lamplight_cells.glsl"

// The sides of the picture, as of a tile: x and y limits as lines over the depth, and the length of their normals.
struct PictureSides {
  vec4 x_edges;
  vec4 y_edges;
  vec4 lengths;
};

PictureSides picture_sides() {
  PictureSides sides;
  tile_edges(frame, vec2(0.0), vec2(frame.size_px), sides.x_edges, sides.y_edges);
  const vec4 slopes = vec4(sides.x_edges.yw, sides.y_edges.yw);
  sides.lengths = sqrt(1.0 + slopes * slopes);
  return sides;
}

bool in_view(LightBounds sphere, PictureSides sides) {
  const float z = -sphere.center.z;
  const vec4 outside = vec4(sides.x_edges.x + sides.x_edges.y * z - sphere.center.x,
                            sphere.center.x - sides.x_edges.z - sides.x_edges.w * z,
                            sides.y_edges.x + sides.y_edges.y * z - sphere.center.y,
                            sphere.center.y - sides.y_edges.z - sides.y_edges.w * z);
  return all(lessThanEqual(outside, sphere.radius * sides.lengths));
}

// Lights of few tiles are held against each tile's depths at once: most of them are hidden or hang in the air.
const uint FEW_TILES = 4u;

bool meets_depths(LightBounds sphere, uvec4 tiles) {
  const uvec2 size = tiles.zw + 1u - tiles.xy;
  if (size.x * size.y > FEW_TILES) return true;
  bool meets = false;
  [[unroll]] for (uint i = 0u; i < FEW_TILES; ++i) {  // beyond its tiles, one of them again
    const uvec2 tile = tiles.xy + uvec2(i % size.x, min(i / size.x, size.y - 1u));
    const TileDepths depths = tile_depths[tile.x + grid_width(TILE_PX) * tile.y];
    const bool met = sphere_meets_mask(sphere, masked_range(depths.z_near, depths.z_far, depths.mask));
    meets = meets || met;  // all looks at once: their way from memory is most of the time
  }
  return meets;
}

LightReach reach_of(LightBounds sphere, uint spot) {
  uvec4 tiles;
  if (!tiles_of_sphere(frame, sphere, TILE_PX, tiles) || !meets_depths(sphere, tiles)) return NO_REACH;
  return LightReach(tiles.x | tiles.y << 16, tiles.z | tiles.w << 16 | spot);
}

// Lights in view that wait until the subgroup has one for every thread: a dense second half of the work. Twice as
// many places as threads; a subgroup uses its own part.
struct SeenLight {
  LightBounds sphere;
  uint light;  // and REACH_OF_SPOT
};
shared SeenLight s_seen[TWICE_THREADS];

// For a subgroup together; each thread with a light or without.
void project_light(SeenLight seen, bool any_light) {
  const uint light = seen.light & ~REACH_OF_SPOT;
  LightReach reach = NO_REACH;
  if (any_light) reach = reach_of(seen.sphere, seen.light & REACH_OF_SPOT);
  const bool kept = reach.first != REACHES_NO_TILE;
  const uvec4 those = subgroupBallot(kept);
  uint place = 0u;
  if (subgroupElect()) place = atomicAdd(s_kept_count, subgroupBallotBitCount(those));
  place = subgroupBroadcastFirst(place) + subgroupBallotExclusiveBitCount(those);
  if (kept) {
    survivors[gl_WorkGroupID.x * BLOCK + place] = light;
    spheres[light] = seen.sphere;
    reaches[light] = reach;
  }
  visit_cells(light, seen.sphere, reach);
}

void project_lights() {
  const PictureSides sides = picture_sides();
  const uint queue = gl_SubgroupID * 2u * gl_SubgroupSize;
  const uint lane = gl_SubgroupInvocationID;
  const uint share = (BLOCK + gl_NumSubgroups - 1u) / gl_NumSubgroups;  // lights of the subgroup
  const uint begin = gl_WorkGroupID.x * BLOCK + gl_SubgroupID * share;
  const uint end = min((gl_WorkGroupID.x + 1u) * BLOCK, frame.light_count);
  uint waiting = 0u;
  uint start = 0u;
  while (start < share || waiting > 0u) {
    if (start < share && waiting < gl_SubgroupSize) {
      const uint light = begin + start + lane;
      LightBounds sphere = LightBounds(vec3(0.0), REACHES_NOTHING);
      uint spot = 0u;
      if (light < min(begin + share, end)) {
        sphere = light_bounds(frame, lights[light]);
        if (lights[light].type == LIGHT_SPOT) spot = REACH_OF_SPOT;
      }
      start += gl_SubgroupSize;
      const bool seen = sphere.radius >= 0.0 && in_view(sphere, sides);
      const uvec4 those = subgroupBallot(seen);
      if (seen) s_seen[queue + waiting + subgroupBallotExclusiveBitCount(those)] = SeenLight(sphere, light | spot);
      waiting += subgroupBallotBitCount(those);
    } else {
      const uint taken = min(waiting, gl_SubgroupSize);
      waiting -= taken;
      subgroupMemoryBarrierShared();
      subgroupBarrier();  // the queue is written before it is read
      project_light(s_seen[queue + waiting + min(lane, taken - 1u)], lane < taken);
      subgroupBarrier();  // and read before it is written anew
    }
  }
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  for (uint cell = thread; cell < CELLS; cell += gl_WorkGroupSize.x) s_counts[cell] = 0u;
  prepare_cells();
  if (thread == 0u) s_kept_count = 0u;
  barrier();  // zeroes before the first light is counted
  project_lights();
  barrier();  // the queue is complete
  visit_waiting_cells();
  barrier();  // every light before the counts are read
  if (thread == 0u) survivor_counts[gl_WorkGroupID.x] = s_kept_count;
  for (uint cell = thread; cell < CELLS; cell += gl_WorkGroupSize.x)
    counts[gl_WorkGroupID.x * CELLS + cell] = s_counts[cell];
}
