// Merges the ordered pieces of a bucket that has several: an entry's place is its place in its piece, and how many of
// each other piece come before it.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
layout(constant_id = 0) const uint HALVES = 4;
#include "methods/world_words.glsl"

layout(local_size_x_id = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 1, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 2, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 3, scalar) readonly buffer RunBuffer { uint runs[]; };  // in the room of the bits
layout(set = 0, binding = 4, scalar) writeonly buffer EntryBuffer { uint entries[]; };

// How many of a run's `count` entries are less than `entry`.
uint smaller_in(uint first, uint count, uint entry) {
  uint begin = 0u;
  uint end = count;
  while (begin < end) {
    const uint middle = (begin + end) / 2u;
    if (runs[first + middle] < entry)
      begin = middle + 1u;
    else
      end = middle;
  }
  return begin;
}

void main() {
  const uint number = gl_WorkGroupID.x + WORLD_GROUPS_ACROSS * gl_WorkGroupID.y;
  if (number >= totals.pieces) return;
  const WorldPiece piece = bucket_pieces[number];
  const WorldBucket bucket = buckets[piece.bucket];
  if (bucket.count <= WORLD_PIECE) return;  // world_order.comp has put it in order
  const uint first = first_word(bucket.first);
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x) {
    const uint entry = runs[first + piece.begin + i];
    uint place = i;
    for (uint run = 0u; run < bucket.count; run += WORLD_PIECE)
      if (run != piece.begin) place += smaller_in(first + run, min(bucket.count - run, WORLD_PIECE), entry);
    entries[bucket.first + place] = entry;
  }
}
