// Puts the entries of a piece of a long bucket in order: a run, left in the room of the bits, for world_merge.comp.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/world.h"

const uint GROUP_THREADS = 64u;
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 1, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 2, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 3, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer RunBuffer { uint runs[]; };

shared uint s_entries[WORLD_PIECE];

void main() {
  const uint number = gl_WorkGroupID.x + WORLD_GROUPS_ACROSS * gl_WorkGroupID.y;
  if (number >= totals.pieces) return;
  const WorldPiece piece = bucket_pieces[number];
  const WorldBucket bucket = buckets[piece.bucket];
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS)
    s_entries[i] = entries[bucket.first + piece.begin + i];
  barrier();  // all entries before they are compared
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS) {
    uint smaller = 0u;
    for (uint k = 0u; k < count; ++k) smaller += uint(s_entries[k] < s_entries[i]);
    runs[2u * bucket.first + piece.begin + smaller] = s_entries[i];
  }
}
