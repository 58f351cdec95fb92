// Rasterizes shadow casters in compute, second part: a group of threads takes a triangle's block of texels, finds
// which of its patches the triangle touches, a thread each, and draws these, a thread a texel.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_triangle.glsl"
#include "common/shadow_texels.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;
layout(set = 0, binding = 3, scalar) readonly buffer GroupBuffer { ShadowGroup groups[]; };
layout(set = 0, binding = 6, scalar) readonly buffer ItemBuffer { uvec2 items[]; };
layout(push_constant, scalar) uniform Push { ShadowRasterBatch batch; };

const uint THREADS = gl_WorkGroupSize.x;
const ivec2 PATCH = ivec2(8, THREADS / 8u);  // texels, a thread each
const ivec2 PATCHES = SHADOW_BLOCK / PATCH;
const uint COUNT = uint(PATCHES.x * PATCHES.y);
const uint WORDS = (COUNT + 31u) / 32u;
shared uint s_touched[WORDS];  // a bit for each patch

ivec2 patch_at(ivec2 low, uint number) {
  return low + ivec2(number % uint(PATCHES.x), number / uint(PATCHES.x)) * PATCH;
}

void find_patches(SquareView square, ShadowTriangle t, ivec2 low, ivec2 high) {
  for (uint i = gl_LocalInvocationIndex; i < COUNT; i += THREADS) {
    const ivec2 first = patch_at(low, i);
    const ivec2 last = min(first + PATCH - 1, high);
    const bool touches = all(lessThanEqual(first, high)) &&
                         may_touch(square, t, texel_center(square, first), texel_center(square, last));
    if (touches) atomicOr(s_touched[i / 32u], 1u << (i % 32u));
  }
}

void draw_patches(SquareView square, ShadowTriangle t, ivec2 low, ivec2 high) {
  const ivec2 own = ivec2(gl_LocalInvocationIndex % uint(PATCH.x), gl_LocalInvocationIndex / uint(PATCH.x));
  for (uint word = 0u; word < WORDS; ++word)
    for (uint left = s_touched[word]; left != 0u; left &= left - 1u) {
      const ivec2 at = patch_at(low, word * 32u + uint(findLSB(left))) + own;
      if (all(lessThanEqual(at, high))) draw_texel(square, t, at);
    }
}

void main() {
  const uint count = min(groups[batch.group].items, batch.most_items);
  for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
    const uint pair = items[i].x;
    const uint triangle = items[i].y & ((1u << SHADOW_BLOCK_X_BIT) - 1u);
    const ivec2 block = ivec2(items[i].y >> SHADOW_BLOCK_X_BIT & 0xffu, items[i].y >> SHADOW_BLOCK_Y_BIT);
    const SquareView square = square_view(batch.first_view + pair % VIEWS_A_BATCH, float(imageSize(atlas).x));
    const ShadowTriangle t = shadow_triangle(square, pair / VIEWS_A_BATCH, triangle);
    const ivec2 low = max(t.low, block * SHADOW_BLOCK);
    const ivec2 high = min(t.high, block * SHADOW_BLOCK + SHADOW_BLOCK - 1);
    if (gl_LocalInvocationIndex < WORDS) s_touched[gl_LocalInvocationIndex] = 0u;
    barrier();  // no bit before the words are clear
    find_patches(square, t, low, high);
    barrier();  // all bits before patches are drawn
    draw_patches(square, t, low, high);
    barrier();  // all have read the words
  }
}
