// The survivors of a block to the cells they were counted in.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint CELLS = 1;
layout(constant_id = 4) const uint BLOCK = 256;
layout(constant_id = 5) const uint ENTRIES = 1;

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer CellDepthBuffer { vec2 cell_depths[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 3, scalar) readonly buffer RectangleBuffer { uvec2 rectangles[]; };
layout(set = 0, binding = 4, scalar) readonly buffer SurvivorBuffer { uint survivors[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
layout(set = 0, binding = 6, scalar) writeonly buffer EntryBuffer { uint entries[]; };

shared uint s_places[CELLS];

void add_entry(uint cell, uint slot) {
  const uint place = atomicAdd(s_places[cell], 1u);
  if (place < ENTRIES) entries[place] = slot;  // a cell that did not fit begins at the end
}
#define VISIT_CELL(cell, slot) add_entry(cell, slot)
#include "methods/lamplight_cells.glsl"

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint kept = survivors[gl_WorkGroupID.x];
  if (kept == 0u) return;
  for (uint cell = thread; cell < CELLS; cell += threads) s_places[cell] = places[gl_WorkGroupID.x * CELLS + cell];
  barrier();  // places before the first entry
  for (uint start = 0u; start < kept; start += threads) {
    const uint slot = gl_WorkGroupID.x * BLOCK + start + thread;
    const bool alive = start + thread < kept;
    LightBounds sphere = LightBounds(vec3(0.0), -1.0);
    uvec2 rectangle = uvec2(0u);
    if (alive) {
      sphere = spheres[slot];
      rectangle = rectangles[slot];
    }
    const uvec4 tiles = uvec4(rectangle & 0xffffu, rectangle >> 16);
    visit_cells(alive, CellVisit(tiles, -sphere.center.z - sphere.radius, -sphere.center.z + sphere.radius, slot));
  }
}
