// Takes the lights of a piece, in order, from the bits of its cell.
// Needs: `cell_bits`, `frame`; common/subgroup_scan.glsl. Gives s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#define LAMP_METHODS_LAMPLIGHT_BIT_ORDER
#extension GL_EXT_control_flow_attributes : require

shared uint s_lights[PIECE];

// Words that a thread loads at once: their way from memory is most of the time.
const uint HELD = 8u;

// What a thread loads of a cell's bits: words [from, to), and what the first of them hold.
struct OrderLoad {
  uint from;
  uint to;
  uint held[HELD];
  uint first_light;  // of these words
};

void load_words(uint from, uint to, out uint held[HELD]) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) held[k] = from + k < to ? cell_bits[from + k] : 0u;
}

OrderLoad load_order(CellPiece piece) {
  const uint words = (light_count_of(frame) + 31u) / 32u;
  const uint strip = (words + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // words of a thread
  OrderLoad load;
  const uint before = min(scan_thread() * strip, words);
  load.from = piece.cell * words + before;
  load.first_light = before * 32u;
  load.to = min(load.from + strip, (piece.cell + 1u) * words);
  load_words(load.from, load.to, load.held);
  return load;
}

// Which of a thread's words hold something: a bit for each, and the last for all from its own on.
const uint LAST_BIT = 31u;

void count_words(uint held[HELD], uint first, inout uint own, inout uint occupied) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    own += uint(bitCount(held[k]));
    occupied |= uint(held[k] != 0u) << min(first + k, LAST_BIT);
  }
}

// By all threads of the group together: the lights of the piece.
void order_lights(OrderLoad load, CellPiece piece) {
  uint own = 0u;
  uint occupied = 0u;
  count_words(load.held, 0u, own, occupied);
  for (uint first = HELD; load.from + first < load.to; first += HELD) {
    load_words(load.from + first, load.to, load.held);
    count_words(load.held, first, own, occupied);
  }
  uint entry = subgroup_scan(own);
  const uint own_end = entry + own > piece.begin ? min(entry + own, piece.begin + piece.count) : entry;
  // Words come again, from the first cache: few hold anything, and code for all of them at once is long.
  uint word = 0u;
  for (uint bits = 0u; entry < own_end; ++entry, bits &= bits - 1u) {
    for (; bits == 0u; ++word) {
      if (word < LAST_BIT) word += uint(findLSB(occupied >> word));
      bits = cell_bits[load.from + word];
    }
    const uint light = load.first_light + (word - 1u) * 32u + uint(findLSB(bits));
    if (entry >= piece.begin) s_lights[entry - piece.begin] = light;
  }
  barrier();  // the piece's lights are there
}

#endif
