// Look-up by triangle: the still lights of a position on a triangle, ascending. `number`: the triangle's, among those that
// the lists were made of, a flat attribute; positions tell patches apart.
//   for (TriangleWalk walk = triangle_walk_begin(number, position); triangle_walk_next(walk, light);) shade(light);
// A shader may say TRIANGLE_LISTS_SET and TRIANGLE_LISTS_BINDING before it includes this.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TRIANGLE_LISTS
#define LAMP_TRIANGLE_LISTS
#include "common/language.glsl"
#include "lamplight/shared/triangle_lists.h"

#ifndef TRIANGLE_LISTS_SET
#define TRIANGLE_LISTS_SET 0
#endif
#ifndef TRIANGLE_LISTS_BINDING
#define TRIANGLE_LISTS_BINDING 14
#endif

#ifdef LAMP_HLSL
[[vk::binding(TRIANGLE_LISTS_BINDING, TRIANGLE_LISTS_SET)]] StructuredBuffer<uint> triangle_words;
#else
layout(set = TRIANGLE_LISTS_SET, binding = TRIANGLE_LISTS_BINDING, scalar) readonly buffer TriangleListWords {
  uint triangle_words[];
};
#endif

struct TriangleWalk {
  uint lights;  // place of the group's first
  uint count;   // of the group
  uint row;     // place of the list's first word of bits
  uint block;   // the first light that `bits` stands for
  uint bits;    // not yet walked
};

// Which of `count` patches a coordinate is in; beyond them, or no number, the nearest.
uint triangle_patch_at(float coordinate, float scale, uint first, uint count) {
  const float at = floor(coordinate * scale) - LAMP_AS_FLOAT(first);
  uint patch_at = 0u;
  if (at > 0.0) patch_at = min(uint(min(at, 255.0)), count - 1u);
  return patch_at;
}

// From a triangle's word down its tables of patches.
uint triangle_list_name(uint word, vec3 position) {
  while ((word & TRIANGLE_PATCHED) != 0u) {
    const uint table = word & ~TRIANGLE_PATCHED;
    const uint head = triangle_words[table];
    const uint axis = LAMP_BITS(head, 0u, TRIANGLE_AXIS_BITS);
    const uint exponent = LAMP_BITS(head, TRIANGLE_AXIS_BITS, TRIANGLE_FIELD_BITS);
    const uint across = LAMP_BITS(head, TRIANGLE_AXIS_BITS + TRIANGLE_FIELD_BITS, TRIANGLE_FIELD_BITS);
    const uint up = LAMP_BITS(head, TRIANGLE_AXIS_BITS + 2u * TRIANGLE_FIELD_BITS, TRIANGLE_FIELD_BITS);
    // 2^-exponent: its bits, for the exponent of a 32-bit float has a bias of 127.
    const float scale = LAMP_AS_FLOAT((127u + TRIANGLE_EXPONENT_BIAS - exponent) << 23u);
    const float u = axis == 0u ? position.y : axis == 1u ? position.z : position.x;
    const float v = axis == 0u ? position.z : axis == 1u ? position.x : position.y;
    const uint x = triangle_patch_at(u, scale, triangle_words[table + 1u], across);
    const uint y = triangle_patch_at(v, scale, triangle_words[table + 2u], up);
    word = triangle_words[table + TRIANGLE_TABLE_HEAD + y * across + x];
  }
  return word;
}

TriangleWalk triangle_walk_begin(uint number, vec3 position) {
  TriangleWalk walk;
  walk.lights = 0u;
  walk.count = 0u;
  walk.row = 0u;
  walk.block = 0u;
  walk.bits = 0u;
  const uint name = triangle_list_name(triangle_words[number], position);
  if (name != TRIANGLE_UNLIT) {
    const uint group = (name >> TRIANGLE_ROW_BITS) * TRIANGLE_GROUP_UNIT;
    walk.count = triangle_words[group];
    walk.lights = group + 1u;
    walk.row = walk.lights + walk.count + (name & (TRIANGLE_ROWS - 1u)) * ((walk.count + 31u) / 32u);
    walk.bits = triangle_words[walk.row];
  }
  return walk;
}

bool triangle_walk_next(inout TriangleWalk walk, out uint light) {
  light = 0u;
  while (walk.bits == 0u) {
    walk.block += 32u;
    if (walk.block >= walk.count) return false;
    walk.bits = triangle_words[walk.row + walk.block / 32u];
  }
  light = triangle_words[walk.lights + walk.block + LAMP_FIRST_BIT(walk.bits)];
  walk.bits &= walk.bits - 1u;
  return true;
}

#endif
