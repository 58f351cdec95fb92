// A walk over the cells that lights may reach, as far as rectangles, depths of cells and narrow cones tell. The cells of a
// subgroup's lights are spread over all of its threads; lights of very many wait in a queue and are walked in strips by
// whichever subgroup is free. Without a depth buffer cells lie in layers, and a light's are a box of them.
// Needs: TILE_PX, CELL_TILES; `frame`, `lights`; SLICED and layers_of(sphere), or `cell_depths`;
// keep_hit(is_hit, light, cell, waiting), for a subgroup together.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_WALK
#define LAMP_METHODS_LAMPLIGHT_WALK
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/subgroup_work.glsl"
#include "methods/lamplight_narrow.glsl"

const uint MANY_CELLS = 64u;      // a light of more waits
const uint WAITING = 32u;         // lights in the queue, at most; others are walked at once
const uint STRIP_OF_THREAD = 4u;  // cells of a strip, for each thread of the subgroup

struct CellRectangle {
  uint corner;  // first cell
  uint size;    // columns, and above 16 bits rows
  uint cells;   // of all layers
  float z_near;
  float z_far;
  uint light;  // and narrow_flag
};

shared CellRectangle s_waiting[WAITING];
shared uint s_arrived;  // may be more than there is room for
shared uint s_next_strip;

// Of the first and last tile; without tiles none.
CellRectangle cells_of(uint light, LightBounds sphere, uvec4 tiles, bool any_tile) {
  const uvec2 first = tiles.xy / CELL_TILES;
  const uvec2 size = tiles.zw / CELL_TILES + 1u - first;
  const uvec2 across = cells_across();
  const float z = -sphere.center.z;
#ifdef SLICED
  const uvec2 layers = layers_of(sphere);
#else
  const uvec2 layers = uvec2(0u);
#endif
  const uint cells = any_tile ? size.x * size.y * (layers.y + 1u - layers.x) : 0u;
  return CellRectangle(first.x + across.x * (first.y + across.y * layers.x), size.x | size.y << 16, cells,
                       z - sphere.radius, z + sphere.radius, light | narrow_flag(light, sphere.radius, cells));
}

CellRectangle rectangle_of_thread(CellRectangle cells, uint thread) {
  return CellRectangle(subgroupShuffle(cells.corner, thread), subgroupShuffle(cells.size, thread),
                       subgroupShuffle(cells.cells, thread), subgroupShuffle(cells.z_near, thread),
                       subgroupShuffle(cells.z_far, thread), subgroupShuffle(cells.light, thread));
}

// Whole part of i / n; exact below 2^22.
uint quotient(uint i, uint n) { return uint((float(i) + 0.5) / float(n)); }

uint cell_of_rectangle(CellRectangle cells, uint i) {
  const uvec2 across = cells_across();
  const uint columns = cells.size & 0xffffu;
  uint cell = cells.corner;
#ifdef SLICED
  const uint in_layer = columns * (cells.size >> 16);
  const uint layer = quotient(i, in_layer);
  i -= layer * in_layer;
  cell += layer * across.x * across.y;
#endif
  return cell + i + (across.x - columns) * quotient(i, columns);
}

bool meets_cell(CellRectangle cells, uint cell) {
  const vec2 depths = depths_of_cell(cell);
  if (cells.z_far < depths.x || cells.z_near > depths.y) return false;
  return (cells.light & NARROW) == 0u || cone_meets_cell(cells.light & ~NARROW, cell, depths);
}

// All below is for the threads of a subgroup together. Cell i of each thread's rectangle, or none.
void visit_cell(CellRectangle cells, uint i, bool any_cell, inout uint waiting) {
  const uint cell = cell_of_rectangle(cells, i);
  keep_hit(any_cell && meets_cell(cells, cell), cells.light & ~NARROW, cell, waiting);
}

// Each thread with a light of its own.
void visit_cells(CellRectangle own, inout uint waiting) {
  if (own.cells > MANY_CELLS) {
    const uint place = atomicAdd(s_arrived, 1u);
    if (place < WAITING) {
      s_waiting[place] = own;
      own.cells = 0u;
    }
  }
  const SharedWork work = share_work(own.cells);
  for (uint start = 0u; start < work.total; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    const WorkItem item = work_item(work, i);
    visit_cell(rectangle_of_thread(own, item.owner), item.number, i < work.total, waiting);
  }
}

uint next_strip() {
  uint strip = 0u;
  if (subgroupElect()) strip = atomicAdd(s_next_strip, 1u);
  return subgroupBroadcastFirst(strip);
}

// After a barrier of the group: the lights in the queue.
void visit_waiting_cells(inout uint waiting) {
  const uint arrived = min(s_arrived, WAITING);
  const uint strip_cells = STRIP_OF_THREAD * gl_SubgroupSize;
  uint first_strip = 0u;  // of the light
  uint strip = arrived == 0u ? 0u : next_strip();
  for (uint light = 0u; light < arrived; ++light) {
    const CellRectangle cells = s_waiting[light];
    const uint strips = (cells.cells + strip_cells - 1u) / strip_cells;
    for (; strip < first_strip + strips; strip = next_strip()) {
      const uint begin = (strip - first_strip) * strip_cells + gl_SubgroupInvocationID;
      for (uint k = 0u; k < STRIP_OF_THREAD; ++k) {
        const uint i = begin + k * gl_SubgroupSize;
        visit_cell(cells, i, i < cells.cells, waiting);
      }
    }
    first_strip += strips;
  }
}

#endif
