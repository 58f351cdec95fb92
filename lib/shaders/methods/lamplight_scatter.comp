// The lights of a block to the cells they were counted in.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/lamplight.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint CELLS = 1;
layout(constant_id = 4) const uint BLOCK = 256;
layout(constant_id = 5) const uint ENTRIES = 1;

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer CellDepthBuffer { uint cell_depths[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 3, scalar) readonly buffer ReachBuffer { LightReach reaches[]; };
layout(set = 0, binding = 4, scalar) readonly buffer SurvivorBuffer { uint survivors[]; };
layout(set = 0, binding = 5, scalar) readonly buffer SurvivorCountBuffer { uint survivor_counts[]; };
layout(set = 0, binding = 6, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
layout(set = 0, binding = 7, scalar) writeonly buffer EntryBuffer { uint entries[]; };

shared uint s_places[CELLS];

void add_entry(uint cell, uint light) {
  const uint place = atomicAdd(s_places[cell], 1u);
  if (place < ENTRIES) entries[place] = light;  // a cell that did not fit begins at the end
}
#define VISIT_CELL(cell, light) add_entry(cell, light)
#include "methods/lamplight_cells.glsl"

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint count = survivor_counts[gl_WorkGroupID.x];
  if (count == 0u) return;
  for (uint cell = thread; cell < CELLS; cell += threads) s_places[cell] = places[gl_WorkGroupID.x * CELLS + cell];
  prepare_cells();
  barrier();  // places before the first entry
  // Few lights are spread over all subgroups.
  const uint share = clamp((count + gl_NumSubgroups - 1u) / gl_NumSubgroups, 1u, gl_SubgroupSize);
  for (uint first = gl_SubgroupID * share; first < count; first += gl_NumSubgroups * share) {
    const uint at = first + gl_SubgroupInvocationID;
    uint light = 0u;
    LightBounds sphere = LightBounds(vec3(0.0), 0.0);
    LightReach reach = NO_REACH;
    if (gl_SubgroupInvocationID < share && at < count) {
      light = survivors[gl_WorkGroupID.x * BLOCK + at];
      sphere = spheres[light];
      reach = reaches[light];
    }
    visit_cells(light, sphere, reach);
  }
  barrier();  // the queue is complete
  visit_waiting_cells();
}
