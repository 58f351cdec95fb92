// Takes the lights of a piece, in order, from the bits of its cell.
// Needs: `cell_bits`, `frame`; common/subgroup_scan.glsl. Gives s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#define LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#extension GL_EXT_control_flow_attributes : require

shared uint s_lights[PIECE];

// Words that a thread loads at once: their way from memory is most of the time.
const uint HELD = 8u;

void load_words(uint from, uint to, out uint held[HELD]) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) held[k] = from + k < to ? cell_bits[from + k] : 0u;
}

// By all threads of the group together: the lights of entries [begin, end) of the cell's.
void order_lights(LightPiece piece, uint begin, uint end) {
  const uint words = (frame.light_count + 31u) / 32u;
  const uint strip = (words + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // words of a thread
  const uint line = piece.cell * words;
  const uint from = line + min(scan_thread() * strip, words);
  const uint to = min(from + strip, line + words);
  uint own = 0u;
  for (uint first = from; first < to; first += HELD) {
    uint held[HELD];
    load_words(first, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) own += uint(bitCount(held[k]));
  }
  uint entry = subgroup_scan(own);
  const uint own_end = min(entry + own, end);
  if (entry + own > begin) {
    // Words come again, from the first cache: few hold anything, and code for all of them at once is long.
    for (uint word = from; entry < own_end; ++word)
      for (uint bits = cell_bits[word]; bits != 0u; bits &= bits - 1u, ++entry)
        if (entry >= begin && entry < end) s_lights[entry - begin] = (word - line) * 32u + uint(findLSB(bits));
  }
  barrier();  // the piece's lights are there
}

#endif
