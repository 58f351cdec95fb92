// From marks to what the look-up reads: lists, or the bits themselves.
// Needs: ROWS, MARK_WORDS; `lists`, `rows`; s_bits, s_lights, bit_word.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_ROW_LISTS
#define LAMP_METHODS_LAMPLIGHT_ROW_LISTS
#extension GL_EXT_control_flow_attributes : require

uint lights_before(uint row, uint word) {
  uint count = 0u;
  [[unroll]] for (uint i = 0u; i < PIECE_WORDS; ++i) count += i < word ? uint(bitCount(s_bits[bit_word(row, i)])) : 0u;
  return count;
}

// Threads share a word of marks where there are more of them than words.
const uint WORD_THREADS = gl_WorkGroupSize.x / (ROWS * PIECE_WORDS);
const uint WORD_PARTS = WORD_THREADS >= 4u ? 4u : WORD_THREADS >= 2u ? 2u : 1u;
const uint PART_BITS = 32u / WORD_PARTS;

// By one thread: the lights of a part of a word of the row's marks, into its list, which begins there.
void write_list_part(uint row, uint part, uint begin) {
  const uint word = part / WORD_PARTS;
  const uint first = part % WORD_PARTS * PART_BITS;
  const uint marks = s_bits[bit_word(row, word)];
  uint place = begin + lights_before(row, word) + uint(bitCount(marks & (1u << first) - 1u));
  for (uint bits = bitfieldExtract(marks, int(first), int(PART_BITS)); bits != 0u; bits &= bits - 1u)
    lists[place++] = s_lights[word * 32u + first + uint(findLSB(bits))];
}

// By all threads of the group together: the marks of its rows, of which that is the first.
void write_bits(uint first_row, uint count) {
  for (uint i = gl_LocalInvocationIndex; i < count * PIECE_WORDS; i += gl_WorkGroupSize.x)
    rows[first_row * PIECE_WORDS + i] = s_bits[i];
}

#endif
