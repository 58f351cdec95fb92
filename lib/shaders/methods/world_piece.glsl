// A piece of a bucket, by one work group: its place, and the bits that its entries' cells have.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x = 64) in;  // a thread for each cell of a brick
#include "methods/world_entry.glsl"

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

uvec2 cells_of_entry(uint entry) {
  const uint light = light_of(entry);
  return cells_of(bricks_of(frame, spheres[light]), light, code_of(entry));
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
