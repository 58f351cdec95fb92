// Which cells a light is counted in and later scattered to: the same pairs both times, because both look at the same
// stored numbers.
// Needs: TILE_PX, CELL_TILES; `frame`, `cell_depths`; the macro VISIT_CELL(cell, slot), called by any thread of the
// subgroup.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELLS
#define LAMP_METHODS_LAMPLIGHT_CELLS
#extension GL_KHR_shader_subgroup_ballot : require

// A thread walks this many cells by itself; lights of more are spread over the subgroup's threads. Chosen on an H100:
// a light that fits into a cell touches at most four.
const uint OWN_CELLS = 4u;

struct CellVisit {
  uvec4 tiles;  // first x, y, last x, y
  float z_near;
  float z_far;
  uint slot;
};

uint grid_width(uint cell_px) { return (frame.size_px.x + cell_px - 1u) / cell_px; }

uvec2 visit_size(CellVisit visit) { return visit.tiles.zw / CELL_TILES - visit.tiles.xy / CELL_TILES + 1u; }

void visit_cell(CellVisit visit, uint i) {
  const uvec2 at = visit.tiles.xy / CELL_TILES + uvec2(i % visit_size(visit).x, i / visit_size(visit).x);
  const uint cell = at.x + grid_width(TILE_PX * CELL_TILES) * at.y;
  const vec2 depths = cell_depths[cell];
  if (visit.z_far >= depths.x && visit.z_near <= depths.y) VISIT_CELL(cell, visit.slot);
}

CellVisit visit_of_lane(CellVisit visit, uint lane) {
  return CellVisit(subgroupBroadcast(visit.tiles, lane), subgroupBroadcast(visit.z_near, lane),
                   subgroupBroadcast(visit.z_far, lane), subgroupBroadcast(visit.slot, lane));
}

// For all threads of the subgroup together.
void visit_cells(bool any_cell, CellVisit visit) {
  const uint cells = any_cell ? visit_size(visit).x * visit_size(visit).y : 0u;
  if (cells <= OWN_CELLS)
    for (uint i = 0u; i < cells; ++i) visit_cell(visit, i);
  const uvec4 active_lanes = subgroupBallot(true);
  const uint rank = subgroupBallotExclusiveBitCount(active_lanes);
  const uint lanes = subgroupBallotBitCount(active_lanes);
  uvec4 wide = subgroupBallot(cells > OWN_CELLS);
  while (any(notEqual(wide, uvec4(0u)))) {
    const uint lane = subgroupBallotFindLSB(wide);
    const CellVisit shared_visit = visit_of_lane(visit, lane);
    const uint count = subgroupBroadcast(cells, lane);
    for (uint i = rank; i < count; i += lanes) visit_cell(shared_visit, i);
    wide[lane / 32u] &= ~(1u << (lane % 32u));
  }
}

#endif
