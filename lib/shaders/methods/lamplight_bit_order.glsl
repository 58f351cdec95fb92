// Takes the lights of a piece, in order, from the bits of its cell.
// Needs: `cell_bits`, `frame`. Gives s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#define LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#extension GL_EXT_control_flow_attributes : require

layout(constant_id = 10) const uint GROUP_THREADS = 256;
#include "common/subgroup_scan.glsl"

shared uint s_lights[PIECE];

// Words that a thread loads at once: their way from memory is most of the time.
const uint HELD = 8u;

void load_words(uint from, uint to, out uint held[HELD]) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) held[k] = from + k < to ? cell_bits[from + k] : 0u;
}

// By one thread: the lights of a word, which are entries from `entry` on.
void take_lights(uint bits, uint first_light, uint entry, uint begin, uint end) {
  for (; bits != 0u && entry < end; bits &= bits - 1u, ++entry)
    if (entry >= begin) s_lights[entry - begin] = first_light + uint(findLSB(bits));
}

// By all threads of the group together: the lights of entries [begin, end) of the cell's.
void order_lights(LightPiece piece, uint begin, uint end) {
  const uint words = (frame.light_count + 31u) / 32u;
  const uint strip = (words + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // words of a thread
  const uint line = piece.cell * words;
  const uint from = line + min(scan_thread() * strip, words);
  const uint to = min(from + strip, line + words);
  uint held[HELD];
  uint own = 0u;
  for (uint first = from; first < to; first += HELD) {
    load_words(first, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) own += uint(bitCount(held[k]));
  }
  uint entry = piece.begin + subgroup_scan(own);
  const bool in_piece = entry < end && entry + own > begin;
  for (uint first = from; in_piece && first < to; first += HELD) {
    if (strip > HELD) load_words(first, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) {
      take_lights(held[k], (first + k - line) * 32u, entry, begin, end);
      entry += uint(bitCount(held[k]));
    }
  }
  barrier();  // the piece's lights are there
}

#endif
