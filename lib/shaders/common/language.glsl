// One source for GLSL and HLSL: what the two spell differently. Who writes HLSL includes a file that ends in .hlsl, which
// says LAMP_HLSL. Beyond these macros, such sources are written in what both languages have: structs are filled member by
// member, vectors are not made of one scalar, no const local is made of specialization constants alone, and nothing that
// reads a buffer or moves a walk stands behind &&, || or ?:, because HLSL before 2021 evaluates both sides.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LANGUAGE
#define LAMP_COMMON_LANGUAGE
#ifdef LAMP_HLSL

#define LAMP_FMA(a, b, c) mad(a, b, c)
#define LAMP_FIRST_BIT(word) firstbitlow(word)
#define LAMP_BIT_COUNT(word) countbits(word)
#define LAMP_BITS(word, first, count) ((word) >> (first) & ((1u << (count)) - 1u))
#define LAMP_DIFFER(a, b) any((a) != (b))
#define LAMP_UNROLL [unroll]
#define LAMP_AS_FLOAT(bits) asfloat(bits)

#else
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require

#define LAMP_FMA(a, b, c) fma(a, b, c)
#define LAMP_FIRST_BIT(word) uint(findLSB(word))  // the lowest that is set
#define LAMP_BIT_COUNT(word) uint(bitCount(word))
#define LAMP_BITS(word, first, count) bitfieldExtract(word, int(first), int(count))  // fewer than 32
#define LAMP_DIFFER(a, b) ((a) != (b))  // vectors, in any component
#define LAMP_UNROLL [[unroll]]
#define LAMP_AS_FLOAT(bits) uintBitsToFloat(bits)

#endif
#endif
