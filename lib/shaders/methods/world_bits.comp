// The cells' bits of a piece of a long bucket, whose entries are in order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "methods/world_piece.glsl"

void main() {
  if (group_number() >= totals.long_pieces) return;
  const WorldPiece piece = bucket_pieces[group_number()];
  const WorldBucket bucket = buckets[piece.bucket];
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS)
    s_entries[i] = entries[bucket.first + piece.begin + i];
  barrier();  // all entries before masks are made of them
  write_bits(bucket, piece.begin, count);
}
