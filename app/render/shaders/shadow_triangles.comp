// Rasterizes shadow casters in compute, first part: a group of threads takes a pair of caster and view, a thread one of its
// triangles. Small triangles are drawn at once; of larger ones each block of texels becomes an item for shadow_blocks.comp.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/shadow_triangle.glsl"
#include "common/shadow_texels.glsl"

layout(local_size_x = 128) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;
layout(set = 0, binding = 3, scalar) buffer GroupBuffer { ShadowGroup groups[]; };
layout(set = 0, binding = 4, scalar) readonly buffer PairBuffer { uint pairs[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer ItemBuffer { uvec2 items[]; };
layout(push_constant, scalar) uniform Push { ShadowRasterBatch batch; };

const int MOST_TEXELS_AT_ONCE = 32;

void draw_texels(SquareView square, ShadowTriangle t, ivec2 low, ivec2 high) {
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) draw_texel(square, t, ivec2(x, y));
}

struct Blocks {
  ivec2 low;
  ivec2 high;
};

bool touches_block(SquareView square, ShadowTriangle t, ivec2 block) {
  const ivec2 low = max(t.low, block * SHADOW_BLOCK);
  const ivec2 high = min(t.high, block * SHADOW_BLOCK + SHADOW_BLOCK - 1);
  return may_touch(square, t, texel_center(square, low), texel_center(square, high));
}

uint count_blocks(SquareView square, ShadowTriangle t, Blocks blocks) {
  uint count = 0u;
  for (int y = blocks.low.y; y <= blocks.high.y; ++y)
    for (int x = blocks.low.x; x <= blocks.high.x; ++x) count += touches_block(square, t, ivec2(x, y)) ? 1u : 0u;
  return count;
}

// What finds no room among the items is drawn here, which takes longer.
void give_out_blocks(SquareView square, ShadowTriangle t, Blocks blocks, uint pair, uint triangle, uint place) {
  for (int y = blocks.low.y; y <= blocks.high.y; ++y)
    for (int x = blocks.low.x; x <= blocks.high.x; ++x) {
      const ivec2 block = ivec2(x, y);
      if (!touches_block(square, t, block)) continue;
      if (place < batch.most_items)
        items[place] = uvec2(pair, triangle | uint(x) << SHADOW_BLOCK_X_BIT | uint(y) << SHADOW_BLOCK_Y_BIT);
      else
        draw_texels(square, t, max(t.low, block * SHADOW_BLOCK), min(t.high, block * SHADOW_BLOCK + SHADOW_BLOCK - 1));
      ++place;
    }
}

void draw_triangle(SquareView square, ShadowTriangle t, uint pair, uint triangle) {
  const ivec2 size = max(t.high - t.low + 1, ivec2(0));
  const bool small = size.x * size.y <= MOST_TEXELS_AT_ONCE;
  const Blocks blocks = Blocks(t.low / SHADOW_BLOCK, t.high / SHADOW_BLOCK);
  const uint count = small ? 0u : count_blocks(square, t, blocks);
  const uint all = subgroupAdd(count);
  uint place = 0u;
  if (all != 0u && subgroupElect()) place = atomicAdd(groups[batch.group].items, all);
  place = subgroupBroadcastFirst(place) + subgroupExclusiveAdd(count);
  if (small) draw_texels(square, t, t.low, t.high);
  if (count != 0u) give_out_blocks(square, t, blocks, pair, triangle, place);
}

void main() {
  const uint first_pair = groups[batch.group].first_caster * VIEWS_A_BATCH;
  const uint count = groups[batch.group].pairs;
  for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
    const uint pair = pairs[first_pair + i];
    const uint caster = pair / VIEWS_A_BATCH;
    const SquareView square = square_view(batch.first_view + pair % VIEWS_A_BATCH, float(imageSize(atlas).x));
    const uint triangles = draws[caster].indices / 3u;
    for (uint first = 0u; first < triangles; first += gl_WorkGroupSize.x) {
      const uint triangle = first + gl_LocalInvocationIndex;
      ShadowTriangle t = shadow_triangle(square, caster, min(triangle, triangles - 1u));
      if (triangle >= triangles) t.high = t.low - 1;
      draw_triangle(square, t, pair, triangle);
    }
  }
}
