// Lights look for their cells: rectangle of tiles, a first look at the depths, then a walk over the cells of the
// rectangle. Pairs of light and cell are kept as a list, of lights in view, or, with CELL_BITS, as bits, of all lights.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint LAYERS = 1;  // of cells
#ifdef SLICED
layout(constant_id = 5) const uint CELL_SLICES = 4;
#define SLICE_CONSTANT 6
#include "common/slice_constants.glsl"
const uint CELL_ROWS = CELL_TILES * CELL_TILES * CELL_SLICES;
#else
const uint CELL_ROWS = CELL_TILES * CELL_TILES;
#endif
#define BOUNDS BOUNDS_MASK
#define SPOT SPOT_CONE_SPHERE
#include "common/light_bounds.glsl"
#include "common/mask_tests.glsl"
#include "common/sphere_rectangle.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
#include "methods/lamplight_cell_count.glsl"
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
#ifdef CELL_BITS
#define DEPTH_BINDING 5
#include "methods/lamplight_bit_hits.glsl"
#else
#define DEPTH_BINDING 7
#include "methods/lamplight_list_hits.glsl"
#endif
#ifndef SLICED
layout(set = 0, binding = DEPTH_BINDING, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
// Half floats.
layout(set = 0, binding = DEPTH_BINDING + 1, scalar) readonly buffer CellDepthBuffer { uint cell_depths[]; };
#endif

#ifdef SLICED
// First and last layer of cells that a sphere's depths reach.
uvec2 layers_of(LightBounds sphere) {
  return slices_of(-sphere.center.z - sphere.radius, -sphere.center.z + sphere.radius) / CELL_SLICES;
}
#endif

#include "methods/lamplight_walk.glsl"

#ifdef SLICED
bool meets_depths(LightBounds sphere, uvec4 tiles) { return true; }
#else
// Lights of few tiles are held against each tile's depths at once: most of them are hidden or hang in the air.
const uint FEW_TILES = 4u;

bool meets_depths(LightBounds sphere, uvec4 tiles) {
  const uvec2 size = tiles.zw + 1u - tiles.xy;
  if (size.x * size.y > FEW_TILES) return true;
  const uint tiles_wide = squares_across(frame, TILE_PX).x;
  bool meets = false;
  [[unroll]] for (uint i = 0u; i < FEW_TILES; ++i) {  // beyond its tiles, one of them again
    const uvec2 tile = tiles.xy + uvec2(i % size.x, min(i / size.x, size.y - 1u));
    const TileDepths depths = tile_depths[tile.x + tiles_wide * tile.y];
    const bool met = sphere_touches_depths(sphere, depths.z_near, depths.z_far) &&
                     parts_near(sphere, depths.z_near, depths.scale, depths.mask) != 0u;
    meets = meets || met;  // all looks at once: their way from memory is most of the time
  }
  return meets;
}
#endif

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    s_arrived = s_next_strip = 0u;
    clear_hits();
  }
  barrier();  // counts of zero before they are added to
  uint light = 0u;
  LightBounds sphere = LightBounds(vec3(0.0), 0.0);
  uvec4 tiles = uvec4(0u);
  bool any_tile = false;
  // A group's share is spread over its subgroups.
  const uint share = group_share();
  const uint of_subgroup = (share + gl_NumSubgroups - 1u) / gl_NumSubgroups;
  const uint in_share = gl_SubgroupID * of_subgroup + gl_SubgroupInvocationID;
  const uint at = gl_WorkGroupID.x * share + in_share;
  if (gl_SubgroupInvocationID < of_subgroup && in_share < share && at < lights_to_find()) {
    light = light_to_find(at);
    sphere = view_bounds(frame, spheres[light]);
    any_tile = tiles_of_sphere(frame, sphere, TILE_PX, tiles) && meets_depths(sphere, tiles);
  }
  uint waiting = 0u;  // hits of the subgroup that are not kept yet
  visit_cells(cells_of(light, sphere, tiles, any_tile), waiting);
  barrier();  // the queue of large lights is complete
  visit_waiting_cells(waiting);
  keep_last_hits(waiting);
}
