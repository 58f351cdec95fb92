// Writes eight words from specialization constants: counts for indirect dispatches and draws.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 1) in;
layout(constant_id = 0) const uint WORD_0 = 0;
layout(constant_id = 1) const uint WORD_1 = 0;
layout(constant_id = 2) const uint WORD_2 = 0;
layout(constant_id = 3) const uint WORD_3 = 0;
layout(constant_id = 4) const uint WORD_4 = 0;
layout(constant_id = 5) const uint WORD_5 = 0;
layout(constant_id = 6) const uint WORD_6 = 0;
layout(constant_id = 7) const uint WORD_7 = 0;
layout(set = 0, binding = 0, scalar) writeonly buffer WordBuffer { uint words[8]; };

void main() { words = uint[](WORD_0, WORD_1, WORD_2, WORD_3, WORD_4, WORD_5, WORD_6, WORD_7); }
