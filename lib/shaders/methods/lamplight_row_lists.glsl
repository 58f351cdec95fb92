// From marks to what the look-up reads: lists, or the bits themselves.
// Needs: MARK_WORDS; `lists`, `rows`; s_bits, s_lights, bit_word.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_ROW_LISTS
#define LAMP_METHODS_LAMPLIGHT_ROW_LISTS
#extension GL_EXT_control_flow_attributes : require

uint lights_before(uint row, uint word) {
  uint count = 0u;
  [[unroll]] for (uint i = 0u; i < PIECE_WORDS; ++i) count += i < word ? uint(bitCount(s_bits[bit_word(row, i)])) : 0u;
  return count;
}

// By one thread: the lights of a word of the row's marks, into its list, which begins there.
void write_list_word(uint row, uint word, uint begin) {
  uint place = begin + lights_before(row, word);
  for (uint bits = s_bits[bit_word(row, word)]; bits != 0u; bits &= bits - 1u)
    lists[place++] = s_lights[word * 32u + uint(findLSB(bits))];
}

// By all threads of the group together: the marks of all its rows, of which that is the first.
void write_bits(uint first_row) {
  for (uint i = gl_LocalInvocationIndex; i < MARK_WORDS; i += gl_WorkGroupSize.x)
    rows[first_row * PIECE_WORDS + i] = s_bits[i];
}

#endif
