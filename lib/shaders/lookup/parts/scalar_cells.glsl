// Walks lists with one cell at a time for the whole subgroup: threads whose cell has its turn walk it together, the others
// wait. What is loaded of a list, and for a light, is then the same for all threads that walk.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Scalarization".
// Promise: each thread that the device counts as active walks its own cell once, whichever are active with it.
// Needs: walk_of_cell, walk_of_cell_in, walk_nothing.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/subgroup.glsl"

#define LOOKUP_IN_TURNS

struct WalkTurns {
  uvec2 cell;  // the thread's own, and its view
  uvec2 turn;  // the one that is walked
  bool done;  // the own one has its turn, or had it
};

// Some devices leave threads out that cover no sample: those would never get a turn. They write nothing, so they need
// none (llvmpipe let them wait for 65 535 rounds: 70 times the shading of the plain walk).
WalkTurns walk_begin_turns(uvec2 pixel, float z_view) {
  const bool takes_part = subgroupInverseBallot(subgroupBallot(true));
  WalkTurns turns;
  turns.cell = uvec2(lookup_cell(LOOKUP_VIEW, pixel, z_view), LOOKUP_VIEW);
  turns.turn = uvec2(0u, 0u);
  turns.done = !takes_part;
  return turns;
}

// The first thread that is left decides, so every turn ends at least one thread's waiting.
bool walk_next_turn(inout WalkTurns turns) {
  if (turns.done) return false;
  turns.turn = subgroupBroadcastFirst(turns.cell);
  turns.done = !LAMP_DIFFER(turns.turn, turns.cell);
  return true;
}

Walk walk_of_turn(WalkTurns turns) {
  if (turns.done) return walk_of_cell(turns.turn.y, turns.turn.x);
  return walk_nothing();
}

#define LOOKUP_EACH(light, pixel, z_view) \
  for (WalkTurns lookup_turns = walk_begin_turns(pixel, z_view); walk_next_turn(lookup_turns);) \
    for (Walk lookup_walk = walk_of_turn(lookup_turns); walk_next(lookup_walk, light);)

Walk walk_of_turn_in(WalkTurns turns, uint first, uint end) {
  if (turns.done) return walk_of_cell_in(turns.turn.y, turns.turn.x, first, end);
  return walk_nothing();
}

#define LOOKUP_EACH_RANGED(id, pixel, z_view, first, end) \
  for (WalkTurns lookup_turns = walk_begin_turns(pixel, z_view); walk_next_turn(lookup_turns);) \
    for (Walk lookup_walk = walk_of_turn_in(lookup_turns, first, end); walk_next(lookup_walk, id);)
