// Which cells a light is counted in and later scattered to: the same pairs both times, because both look at the same
// stored numbers. A thread walks the cells of its light if they are few, a team of threads if there are more; lights of
// very many wait in a queue and are walked in strips by whichever subgroup is free.
// Needs: TILE_PX, CELL_TILES, CELLS; `frame`, `cell_depths`; the macro VISIT_CELL(cell, light).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELLS
#define LAMP_METHODS_LAMPLIGHT_CELLS
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#include "lamplight/shared/lamplight.h"

const LightReach NO_REACH = LightReach(REACHES_NO_TILE, 0u);

const uint OWN_CELLS = 4u;        // a thread walks that many by itself
const uint TEAM_CELLS = 256u;     // a team that many
const uint TEAM = 8u;             // threads, or all of a smaller subgroup
const uint WAITING = 64u;         // lights in the queue, at most; others are walked by a team
const uint STRIP_OF_THREAD = 4u;  // cells of a strip, for each thread of the subgroup

struct CellRectangle {
  uint corner;  // first cell
  uint columns;
  uint cells;
  float z_near;
  float z_far;
  uint light;
};

shared CellRectangle s_waiting[WAITING];
shared uint s_arrived;  // may be more than there is room for
shared uint s_next_strip;

// Nearest and farthest depth of each cell, as half floats: loaded by everyone at once, because a walk that went to memory
// for each would wait most of its time.
shared uint s_depths[CELLS];

// By all threads of the group, before a barrier.
void prepare_cells() {
  for (uint cell = gl_LocalInvocationIndex; cell < CELLS; cell += gl_WorkGroupSize.x) s_depths[cell] = cell_depths[cell];
  if (gl_LocalInvocationIndex == 0u) s_arrived = s_next_strip = 0u;
}

uint grid_width(uint cell_px) { return (frame.size_px.x + cell_px - 1u) / cell_px; }

uvec2 tile_of(uint packed_tile) { return uvec2(packed_tile & 0xffffu, packed_tile >> 16); }

CellRectangle cells_of(uint light, LightBounds sphere, LightReach reach) {
  if (reach.first == REACHES_NO_TILE) return CellRectangle(0u, 1u, 0u, 0.0, 0.0, light);
  const uvec2 first = tile_of(reach.first) / CELL_TILES;
  const uvec2 size = tile_of(reach.last & ~REACH_OF_SPOT) / CELL_TILES + 1u - first;
  const uint corner = first.x + grid_width(TILE_PX * CELL_TILES) * first.y;
  return CellRectangle(corner, size.x, size.x * size.y, -sphere.center.z - sphere.radius,
                       -sphere.center.z + sphere.radius, light);
}

CellRectangle rectangle_of_thread(CellRectangle cells, uint thread) {
  return CellRectangle(subgroupShuffle(cells.corner, thread), subgroupShuffle(cells.columns, thread),
                       subgroupShuffle(cells.cells, thread), subgroupShuffle(cells.z_near, thread),
                       subgroupShuffle(cells.z_far, thread), subgroupShuffle(cells.light, thread));
}

void visit_cell(CellRectangle cells, uint cell) {
  const vec2 depths = unpackHalf2x16(s_depths[cell]);
  if (cells.z_far >= depths.x && cells.z_near <= depths.y) VISIT_CELL(cell, cells.light);
}

// Cells begin, begin + step, ... below end.
void visit_some_cells(CellRectangle cells, uint width, uint begin, uint end, uint step) {
  const float per_column = 1.0 / float(cells.columns);
  for (uint i = begin; i < end; i += step) {
    const uint row = uint((float(i) + 0.5) * per_column);  // exact: there are a few thousand cells
    visit_cell(cells, cells.corner + i + (width - cells.columns) * row);
  }
}

// For all threads of a full subgroup together, each with a light of its own.
void visit_cells(uint light, LightBounds sphere, LightReach reach) {
  const uint width = grid_width(TILE_PX * CELL_TILES);
  CellRectangle own = cells_of(light, sphere, reach);
  if (own.cells <= OWN_CELLS) {
    visit_some_cells(own, width, 0u, own.cells, 1u);
    own.cells = 0u;
  } else if (own.cells > TEAM_CELLS) {
    const uint place = atomicAdd(s_arrived, 1u);
    if (place < WAITING) {
      s_waiting[place] = own;
      own.cells = 0u;
    }
  }
  const uint team = min(TEAM, gl_SubgroupSize);
  const uint member = gl_SubgroupInvocationID % team;
  for (uint i = 0u; i < team; ++i) {
    if (subgroupAll(member != i || own.cells == 0u)) continue;
    const CellRectangle cells = rectangle_of_thread(own, gl_SubgroupInvocationID - member + i);
    visit_some_cells(cells, width, member, cells.cells, team);
  }
}

uint next_strip() {
  uint strip = 0u;
  if (subgroupElect()) strip = atomicAdd(s_next_strip, 1u);
  return subgroupBroadcastFirst(strip);
}

// For all threads of the group together, after a barrier: the lights in the queue.
void visit_waiting_cells() {
  const uint width = grid_width(TILE_PX * CELL_TILES);
  const uint arrived = min(s_arrived, WAITING);
  const uint strip_cells = STRIP_OF_THREAD * gl_SubgroupSize;
  uint first_strip = 0u;  // of the light
  uint strip = next_strip();
  for (uint i = 0u; i < arrived; ++i) {
    const CellRectangle cells = s_waiting[i];
    const uint strips = (cells.cells + strip_cells - 1u) / strip_cells;
    for (; strip < first_strip + strips; strip = next_strip()) {
      const uint begin = (strip - first_strip) * strip_cells;
      visit_some_cells(cells, width, begin + gl_SubgroupInvocationID, min(begin + strip_cells, cells.cells),
                       gl_SubgroupSize);
    }
    first_strip += strips;
  }
}

#endif
