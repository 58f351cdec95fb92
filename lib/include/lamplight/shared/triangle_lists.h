// The words of triangle lists: how a triangle's word, a tree of patches and a group of lists are read.
// Promise: the same numbers in C++, in GLSL and in HLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_TRIANGLE_LISTS_H
#define LAMPLIGHT_SHARED_TRIANGLE_LISTS_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// Word t stands for triangle t. With TRIANGLE_PATCHED, its other bits are the place of a table of patches; a table has
// a word for each patch, which may be another table. Without it, a word names a list: the group of lists that begins
// TRIANGLE_GROUP_UNIT words times (word >> TRIANGLE_ROW_BITS) from the first word, and which of its rows.
LAMP_CONST TRIANGLE_PATCHED = 0x80000000u;
LAMP_CONST TRIANGLE_UNLIT = 0x7fffffffu;  // no list: no light
LAMP_CONST TRIANGLE_ROW_BITS = 6u;
LAMP_CONST TRIANGLE_ROWS = 64u;  // of a group, at most
LAMP_CONST TRIANGLE_GROUP_UNIT = 2u;

// A table: a word of these fields, the whole numbers (as 32-bit floats) that the first patch's corner is in patches,
// and `across` times `up` words. Patches are squares of side 2^(exponent - TRIANGLE_EXPONENT_BIAS) m, seen along an
// axis.
LAMP_CONST TRIANGLE_TABLE_HEAD = 3u;  // words before a table's patches
LAMP_CONST TRIANGLE_FIELD_BITS = 8u;  // of the exponent, `across` and `up`, behind 2 bits of the axis
LAMP_CONST TRIANGLE_AXIS_BITS = 2u;   // 0: seen along x, u is y and v is z; 1: along y, z and x; 2: along z, x and y
LAMP_CONST TRIANGLE_EXPONENT_BIAS = 128u;

// A group: its number of lights n, n lights, ascending; then rows of (n + 31) / 32 words, a bit for each light.

#ifdef __cplusplus
static_assert(TRIANGLE_ROWS == 1U << TRIANGLE_ROW_BITS);
}  // namespace lamp::shared
#endif

#endif
