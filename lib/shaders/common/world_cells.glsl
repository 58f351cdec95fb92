// Bricks of cells in the world, for lists and for look-ups, in GLSL and in HLSL. Sides are powers of two, so that the
// brick and the cell of a position are exact, however far from the origin.
// Based on: Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, VMV (2003); the
// mixing of Ellis, lowbias32, Prospecting for Hash Functions (2018).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_WORLD_CELLS
#define LAMP_COMMON_WORLD_CELLS
#include "common/language.glsl"
#include "lamplight/shared/world.h"

const uint EXPONENT_OF_1 = 127u;  // of a float
const uint MANTISSA_BITS = 23u;

// Metres, and how many bricks a metre.
float brick_side(uint level) { return LAMP_AS_FLOAT((EXPONENT_OF_1 + level - WORLD_LEAST) << MANTISSA_BITS); }
float bricks_a_metre(uint level) { return LAMP_AS_FLOAT((EXPONENT_OF_1 + WORLD_LEAST - level) << MANTISSA_BITS); }

// Remainders of a brick's coordinates, and the code that they make. No brick is as far out as the divisor's multiple.
uvec3 brick_remainders(vec3 brick) {
  const int multiple = int(MOST_BRICKS_ACROSS << 20);
  return uvec3(uint(int(brick.x) + multiple), uint(int(brick.y) + multiple), uint(int(brick.z) + multiple)) %
         MOST_BRICKS_ACROSS;
}
uint brick_code(vec3 brick) {
  const uvec3 at = brick_remainders(brick);
  return at.x + MOST_BRICKS_ACROSS * (at.y + MOST_BRICKS_ACROSS * at.z);
}
uint light_of_entry(uint entry) { return entry >> ENTRY_CODE_BITS; }
uint code_of_entry(uint entry) { return entry & (1u << ENTRY_CODE_BITS) - 1u; }

// Of buckets, whose number is a power of two, 8 at least. The brick's coordinates are whole numbers. The 2 x 2 x 2 bricks of
// a block have buckets in a row, so that most of what a light reaches lies together. Their order is the hash's, too: of blocks
// that share buckets few have bricks of the same code there.
uint bucket_of(uint level, vec3 brick, uint buckets) {
  const uvec3 at = uvec3(uint(int(brick.x)), uint(int(brick.y)), uint(int(brick.z)));
  const uvec3 block = uvec3(uint(int(brick.x) >> 1), uint(int(brick.y) >> 1), uint(int(brick.z) >> 1));
  uint hash = block.x * 0x8da6b343u + block.y * 0xd8163841u + block.z * 0xcb1ab31fu + level * 0x9e3779b9u;
  hash = (hash ^ (hash >> 16)) * 0x7feb352du;
  hash = (hash ^ (hash >> 15)) * 0x846ca68bu;
  hash ^= hash >> 16;
  const uint in_block = (at.z & 1u) << 2 | (at.y & 1u) << 1 | (at.x & 1u);
  return ((hash << 3 | hash >> 29) ^ in_block) & (buckets - 1u);
}

#endif
