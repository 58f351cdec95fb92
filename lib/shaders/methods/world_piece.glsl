// A piece of a bucket, by one work group: its place, and the bits that its entries' cells have.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x = 64) in;  // a thread for each cell of a brick
layout(constant_id = 0) const float BRICK_RATIO = 1.0;
#include "common/world_bricks.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 6, scalar) buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };

const uint GROUP_THREADS = 64u;
const uint BLOCK = 32u;  // entries

shared uint s_entries[WORLD_PIECE];  // in order
shared uvec2 s_masks[WORLD_PIECE];
shared uint s_fields[BRICK_CELLS];

uint light_of(uint entry) { return entry >> ENTRY_BRICK_BITS; }

// The group's number, as the scan counted groups.
uint group_number() { return gl_WorkGroupID.x + WORLD_GROUPS_ACROSS * gl_WorkGroupID.y; }

// Squared distances of four cells in a row, along one axis.
vec4 squared_outside(float position, float low, float side) {
  const vec4 begin = low + side * vec4(0.0, 1.0, 2.0, 3.0);
  const vec4 outside = max(max(begin - position, position - (begin + side)), vec4(0.0));
  return outside * outside;
}

// A bit for each cell that the light's sphere reaches.
uvec2 cells_of_sphere(LightBricks b, vec3 low, float side) {
  const vec4 x = squared_outside(b.center.x, low.x, side);
  const vec4 y = squared_outside(b.center.y, low.y, side);
  const vec4 z = squared_outside(b.center.z, low.z, side);
  uvec2 mask = uvec2(0u);
  for (uint row = 0u; row < 16u; ++row) {
    const float left = b.radius * b.radius - y[row % 4u] - z[row / 4u];
    const uvec4 reached = uvec4(lessThanEqual(x, vec4(left))) << uvec4(0u, 1u, 2u, 3u);
    mask[row / 8u] |= (reached.x | reached.y | reached.z | reached.w) << 4u * (row % 8u);
  }
  return mask;
}

uint cells_of_cone(WorldCone cone, vec3 low, float side, uint first_cell, uint mask) {
  uint reached = 0u;
  for (uint left = mask; left != 0u; left &= left - 1u) {
    const uint bit = uint(findLSB(left));
    const uint cell = first_cell + bit;
    const vec3 at = low + side * vec3(cell % 4u, cell / 4u % 4u, cell / 16u);
    if (cone_touches_cube(cone, at, side)) reached |= 1u << bit;
  }
  return reached;
}

uvec2 cells_of_entry(uint entry) {
  const uint light = light_of(entry);
  const LightBricks b = bricks_of(frame, spheres[light]);
  if (b.level == WORLD_EVERYTHING) return uvec2(~0u);
  const float side = brick_side(b.level);
  const vec3 low = side * brick_of_code(b, entry & (1u << ENTRY_BRICK_BITS) - 1u);
  const uvec2 mask = cells_of_sphere(b, low, 0.25 * side);
  if (lights[light].type != LIGHT_SPOT) return mask;
  const WorldCone cone = world_cone(frame, lights[light]);
  return uvec2(cells_of_cone(cone, low, 0.25 * side, 0u, mask.x), cells_of_cone(cone, low, 0.25 * side, 32u, mask.y));
}

// A light may have several bricks in one bucket. Its first entry has the cells of all of them, the others have none, so
// that no walk meets it twice.
uvec2 cells_of_light(WorldBucket bucket, uint begin, uint count, uint i) {
  const uint at = begin + i;
  const uint light = light_of(s_entries[i]);
  if (at != 0u) {
    const uint before = i != 0u ? s_entries[i - 1u] : entries[bucket.first + at - 1u];
    if (light_of(before) == light) return uvec2(0u);
  }
  uvec2 mask = uvec2(0u);
  for (uint k = 0u; at + k < bucket.count; ++k) {
    const uint entry = i + k < count ? s_entries[i + k] : entries[bucket.first + at + k];
    if (light_of(entry) != light) break;
    mask |= cells_of_entry(entry);
  }
  return mask;
}

// Word `word` of a block whose cells have `width` bits each: parts of the fields of several cells.
uint word_of_block(uint word, uint width) {
  uint bits_of_word = 0u;
  const uint begin = word * BLOCK;
  for (uint cell = begin / width; cell * width < begin + BLOCK && cell < BRICK_CELLS; ++cell) {
    const uint at = cell * width;
    bits_of_word |= at >= begin ? s_fields[cell] << (at - begin) : s_fields[cell] >> (begin - at);
  }
  return bits_of_word;
}

// By all threads of the group together: the bits of the piece, whose ordered entries are in s_entries.
void write_bits(WorldBucket bucket, uint begin, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  for (uint i = thread; i < count; i += GROUP_THREADS) s_masks[i] = cells_of_light(bucket, begin, count, i);
  for (uint block = 0u; block < count; block += BLOCK) {
    const uint width = min(count - block, BLOCK);
    barrier();  // all masks, and the words of the last block, before fields are made
    uint field = 0u;
    for (uint i = 0u; i < width; ++i) field |= (s_masks[block + i][thread / 32u] >> thread % 32u & 1u) << i;
    s_fields[thread] = field;
    barrier();  // all fields before words are made of them
    if (thread < 2u * width) bits[2u * (bucket.first + begin + block) + thread] = word_of_block(thread, width);
  }
}
