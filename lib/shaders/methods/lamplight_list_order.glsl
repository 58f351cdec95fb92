// Puts the lights of a piece in order. A cell's entries come as runs, one of each block and in the order of blocks, but in
// any order within: scattering is a race. Most runs are short; then each light counts who of its run comes before it. A
// long run is drawn as bits, one for each light of its block, and read off again.
// Needs: `entries`, `places`, `frame`. Gives s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_LIST_ORDER
#define LAMP_METHODS_LAMPLIGHT_LIST_ORDER

layout(constant_id = 10) const uint RUN_WORDS = 8;  // bits of a block
layout(constant_id = 11) const uint BLOCK = 256;    // lights
layout(constant_id = 12) const uint LAYERS = 1;     // of cells

#include "methods/lamplight_cell_count.glsl"

const uint LONG_RUN = 32u;
const uint MARGIN = LONG_RUN;  // a run that is not long and reaches into the piece begins and ends within it
const uint BLOCK_WORDS = (BLOCK + 31u) / 32u;
const uint LONG_RUNS = 16u;  // in a piece, at most: PIECE / LONG_RUN and one at either end

shared uint s_lights[PIECE];
shared uint s_window[PIECE + 2u * MARGIN];  // the piece's entries and MARGIN before and after
shared uint s_long_runs[LONG_RUNS];
shared uint s_long_run_count;
shared uint s_run_bits[RUN_WORDS];

struct Window {
  uint begin;  // of the piece, of entries
  uint end;
  uint first;  // of the window
  uint count;
};

uint block_of(uint at) { return s_window[at] / BLOCK; }

// By one thread for each entry of the window.
void place_light(Window window, uint at) {
  const uint light = s_window[at];
  uint before = 0u;
  uint smaller = 0u;
  uint after = 0u;
  for (uint i = at; i > 0u && before <= LONG_RUN && block_of(i - 1u) == light / BLOCK; --i, ++before)
    smaller += uint(s_window[i - 1u] < light);
  for (uint i = at + 1u; i < window.count && after <= LONG_RUN && block_of(i) == light / BLOCK; ++i, ++after)
    smaller += uint(s_window[i] < light);
  const uint entry = window.first + at;
  if (before + 1u + after <= LONG_RUN) {
    const uint place = entry - before + smaller;
    if (place >= window.begin && place < window.end) s_lights[place - window.begin] = light;
  } else if (entry == window.begin || (entry > window.begin && entry < window.end && before == 0u)) {
    s_long_runs[atomicAdd(s_long_run_count, 1u)] = light / BLOCK;
  }
}

// By all threads of the group together.
void place_long_run(Window window, LightPiece piece, uint block) {
  const uint blocks = (light_count_of(frame) + BLOCK - 1u) / BLOCK;
  const uint begin = places[block * cell_count() + piece.cell];
  const uint end = block + 1u < blocks ? places[(block + 1u) * cell_count() + piece.cell] : piece.end;
  for (uint i = gl_LocalInvocationIndex; i < BLOCK_WORDS; i += gl_WorkGroupSize.x) s_run_bits[i] = 0u;
  barrier();  // zeroes before the first bit
  for (uint i = begin + gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x) {
    const uint bit = entries[i] - block * BLOCK;
    atomicOr(s_run_bits[bit / 32u], 1u << (bit % 32u));
  }
  barrier();  // all bits before they are read off
  for (uint word = gl_LocalInvocationIndex; word < BLOCK_WORDS; word += gl_WorkGroupSize.x) {
    uint place = begin;
    for (uint i = 0u; i < word; ++i) place += uint(bitCount(s_run_bits[i]));
    for (uint bits = s_run_bits[word]; bits != 0u; bits &= bits - 1u, ++place)
      if (place >= window.begin && place < window.end)
        s_lights[place - window.begin] = block * BLOCK + word * 32u + uint(findLSB(bits));
  }
  barrier();  // read off before the next run
}

// What of its cell a piece is.
struct OrderLoad {
  LightPiece listed;
};
OrderLoad load_order(CellPiece piece) { return OrderLoad(cell_pieces[piece.place]); }

// By all threads of the group together: the lights of the piece, from the cell's ordered entries.
void order_lights(OrderLoad load, CellPiece own) {
  const LightPiece piece = load.listed;
  const uint begin = own.begin;
  const uint end = begin + own.count;
  Window window = Window(begin, end, max(begin, piece.begin + MARGIN) - MARGIN, 0u);
  window.count = min(end + MARGIN, piece.end) - window.first;
  for (uint i = gl_LocalInvocationIndex; i < window.count; i += gl_WorkGroupSize.x)
    s_window[i] = entries[window.first + i];
  if (gl_LocalInvocationIndex == 0u) s_long_run_count = 0u;
  barrier();  // the window before runs are looked for
  for (uint i = gl_LocalInvocationIndex; i < window.count; i += gl_WorkGroupSize.x) place_light(window, i);
  barrier();  // the order, but for long runs
  for (uint i = 0u; i < s_long_run_count; ++i) place_long_run(window, piece, s_long_runs[i]);
}

#endif
