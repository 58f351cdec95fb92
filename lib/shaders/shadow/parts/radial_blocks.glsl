// How a light's map is cut into blocks of texels, what each of them may light, and how far it reaches.
// Needs: gl_WorkGroupSize; shadow/parts/radial_cells.glsl, shadow/parts/radial_reach.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_RADIAL_BLOCKS
#define LAMP_SHADOW_RADIAL_BLOCKS

const uint BLOCKS = 16u;             // a side of a square, half of a cell's angle and less
const uint OCTAHEDRON_BLOCKS = 32u;  // which holds all directions
// Texels: all around a light smaller ones say hardly more, since taps and offsets are as large, and take longer.
const uint LEAST_BLOCK = 4u;
const uint LEAST_OCTAHEDRON_BLOCK = 2u;
const int DIRECT_SIZE = 4;  // texels a side: a thread reads a block as small as this alone
const uint MOST_BLOCKS = max(OCTAHEDRON_BLOCKS * OCTAHEDRON_BLOCKS, SQUARES_A_LIGHT * BLOCKS * BLOCKS);
// A group of few threads holds a part of a map's blocks at a time: shared memory bounds how many groups are under way. On an
// H200 many small maps take 0.49 ms so, 0.73 with all of them. Of few large maps a group has 96 blocks, and the loop is in the way.
const bool HOLDS_ALL = gl_WorkGroupSize.x > 256u;
const uint HELD_BLOCKS = HOLDS_ALL ? MOST_BLOCKS : 256u;
shared uint s_nearest_stored[HELD_BLOCKS];  // bits of near / w of a larger block's farthest texel

// How maps of a kind and side are cut into blocks; all are powers of two.
struct Cut {
  uint kind;
  uint side;        // texels
  uint blocks;      // a side
  uint block_bits;  // of their number
  uint size;        // of a block, texels a side
  uint all_blocks;  // of a light
};

Cut cut_of(uint light) {
  Cut cut;
  cut.kind = shadow_maps[light].kind;
  cut.side = max(shadow_maps[light].side, LEAST_SQUARE);
  const uint least = cut.kind == SHADOW_SPOT ? 1u : cut.kind == SHADOW_FACES ? LEAST_BLOCK : LEAST_OCTAHEDRON_BLOCK;
  cut.blocks = min(cut.side / least, cut.kind == SHADOW_OCTAHEDRON ? OCTAHEDRON_BLOCKS : BLOCKS);
  cut.block_bits = uint(findMSB(cut.blocks));
  cut.size = cut.side >> cut.block_bits;
  cut.all_blocks = (cut.kind == SHADOW_FACES ? SQUARES_A_LIGHT : 1u) << (2u * cut.block_bits);
  return cut;
}

uint square_of(Cut cut, uint block) { return block >> (2u * cut.block_bits); }

// Its first texel.
uvec2 place_of(Cut cut, uint block) {
  return (uvec2(block, block >> cut.block_bits) & (cut.blocks - 1u)) * cut.size;
}

// Of whole rows of blocks, at most HELD_BLOCKS, by all threads of the group together. A thread takes a column of a block; those of a row lie together in memory.
void farthest_of_blocks(uint light, Cut cut, uint first, uint end) {
  for (uint i = first + gl_LocalInvocationIndex; i < end; i += gl_WorkGroupSize.x)
    s_nearest_stored[i % HELD_BLOCKS] = floatBitsToUint(1.0);
  barrier();  // initial values before texels are nearer
  const uint side_bits = uint(findMSB(cut.side));
  const uint last = end * cut.size;
  for (uint column = first * cut.size + gl_LocalInvocationIndex; column < last; column += gl_WorkGroupSize.x) {
    const uint row = column >> side_bits;  // of blocks, in all squares
    const uint x = column & (cut.side - 1u);
    const ivec2 texel = ivec2(x, (row & (cut.blocks - 1u)) * cut.size);
    const float stored =
        radial_least_of_column(shadow_square(light, row >> cut.block_bits), texel, int(cut.size));
    atomicMin(s_nearest_stored[((row << cut.block_bits) + x / cut.size) % HELD_BLOCKS], floatBitsToUint(stored));
  }
}

float farthest_of_block(uint light, Cut cut, uint block) {
  const ShadowSquare square = shadow_square(light, square_of(cut, block));
  const ivec2 first = ivec2(place_of(cut, block));
  float stored[DIRECT_SIZE * DIRECT_SIZE];  // all are asked for before the first is waited for
  [[unroll]] for (int i = 0; i < DIRECT_SIZE * DIRECT_SIZE; ++i) {
    const ivec2 at = ivec2(i % DIRECT_SIZE, i / DIRECT_SIZE);
    stored[i] = 1.0;
    if (max(at.x, at.y) < int(cut.size)) stored[i] = SHADOW_TEXEL(shadow_atlas, square.corner + first + at).x;
  }
  float least = 1.0;
  [[unroll]] for (int i = 0; i < DIRECT_SIZE * DIRECT_SIZE; ++i) least = min(least, stored[i]);
  return max(least, 0.0);
}

#endif
