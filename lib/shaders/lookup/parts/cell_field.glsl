// The bits of a cell in a block of `width` entries whose words begin at `first`.
// Needs: LOOKUP_CELL_WORD(word), which reads one. SPDX-License-Identifier: Apache-2.0
uint lookup_field(uint first, uint cell, uint width) {
  const uint at = cell * width;
  const uint word = first + at / 32u;
  const uint shift = at % 32u;
  uint field = LOOKUP_CELL_WORD(word) >> shift;
  if (shift + width > 32u) field |= LOOKUP_CELL_WORD(word + 1u) << (32u - shift);
  if (width < 32u) field &= (1u << width) - 1u;
  return field;
}
