// `width` bits of words, up to 32, from bit `at` of word `first` on: a function called CELL_FIELD.
// Needs: CELL_FIELD, its name; CELL_FIELD_WORD(word), which reads one. Both are forgotten then: a shader may include this
// for several buffers.
// SPDX-License-Identifier: Apache-2.0
uint CELL_FIELD(uint first, uint at, uint width) {
  const uint word = first + at / 32u;
  const uint shift = at % 32u;
  uint field = CELL_FIELD_WORD(word) >> shift;
  if (shift + width > 32u) field |= CELL_FIELD_WORD(word + 1u) << (32u - shift);
  if (width < 32u) field &= (1u << width) - 1u;
  return field;
}
#undef CELL_FIELD
#undef CELL_FIELD_WORD
