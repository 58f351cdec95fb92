// From a row of cells for each entry to a row of entries for each cell: the bits of a block of up to 32 entries.
// Based on: Warren, Hacker's Delight, 2nd ed. (2012), 7-3: transposing an 8 x 8 matrix of bits.
// Likewise of slices. Needs: s_cells, two words for each entry, with room for 8 entries more; s_bits, zeroed.
// SPDX-License-Identifier: Apache-2.0
#include "methods/world_words.glsl"

const uint BLOCK = 32u;  // entries
const uint OCTETS = 2u * HALVES;

struct Octet {
  uint entries[8];  // for each of eight cells in turn, a bit for each entry of a block
};

uvec2 transpose(uvec2 rows) {
  uvec2 swap = (rows ^ rows >> 7u) & 0x00aa00aau;
  rows ^= swap ^ swap << 7u;
  swap = (rows ^ rows >> 14u) & 0x0000ccccu;
  rows ^= swap ^ swap << 14u;
  const uint last = (rows.x ^ rows.y << 4u) & 0xf0f0f0f0u;
  return rows ^ uvec2(last, last >> 4u);
}

// Bits behind the block's entries are any.
Octet octet_of(uint begin, uint count, uint number) {
  Octet octet;
  [[unroll]] for (uint cell = 0u; cell < 8u; ++cell) octet.entries[cell] = 0u;
  for (uint i = 0u; i < count; i += 8u) {
    uvec2 rows = uvec2(0u);
    [[unroll]] for (uint k = 0u; k < 8u; ++k) {
      const uint word = s_cells[2u * (begin + i + k) + number / 4u];
      rows[k / 4u] |= bitfieldExtract(word, int(8u * (number % 4u)), 8) << 8u * (k % 4u);
    }
    const uvec2 columns = transpose(rows);
    [[unroll]] for (uint cell = 0u; cell < 8u; ++cell)
      octet.entries[cell] |= (columns[cell / 4u] >> 8u * (cell % 4u) & 255u) << i;
  }
  return octet;
}

// Eight cells of the block of `count` entries at `begin`: `count` bits for each cell, one cell behind the other.
void write_octet(uint begin, uint count, uint number) {
  const Octet octet = octet_of(begin, count, number);
  const uint block_entries = ~0u >> BLOCK - count;
  uint word = first_word(begin) + 8u * number * count / 32u;
  uint filled = 8u * number * count % 32u;
  uint made = 0u;
  [[unroll]] for (uint cell = 0u; cell < 8u; ++cell) {
    const uint field = octet.entries[cell] & block_entries;
    made |= field << filled;
    filled += count;
    if (filled >= 32u) {
      atomicOr(s_bits[word], made);
      ++word;
      filled -= 32u;
      made = filled == 0u ? 0u : field >> count - filled;
    }
  }
  if (filled != 0u) atomicOr(s_bits[word], made);
}
