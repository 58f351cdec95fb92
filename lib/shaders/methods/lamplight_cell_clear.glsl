// A cell whose lights other passes find: its depths for them, and zeroes to count or keep lights in.
// Needs: `frame`, `cells`. Gives prepare_cell, finish_cell.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELL_CLEAR
#define LAMP_METHODS_LAMPLIGHT_CELL_CLEAR

layout(constant_id = 4) const uint BLOCK = 256;  // lights

layout(set = 0, binding = 4, scalar) writeonly buffer CountBuffer { uint counts[]; };  // blocks times cells, or bits
layout(set = 0, binding = 5, scalar) writeonly buffer CellDepthBuffer { uint cell_depths[]; };  // half floats

// A share of the zeroes, by all threads of the group together: here they cost little, because all wait for the depth
// buffer.
void prepare_cell() {
  const uint cells = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
  const uint words = (frame.light_count + BLOCK - 1u) / BLOCK * cells;
  const uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  for (uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex; i < words; i += cells * gl_WorkGroupSize.x)
    counts[i] = 0u;
}

void finish_cell(uint cell, vec2 depths) {
  if (gl_LocalInvocationIndex != 0u) return;
  cell_depths[cell] = packHalf2x16(depths);
  cells[cell] = LightCell(0u, 0u, 0u);
}

#endif
