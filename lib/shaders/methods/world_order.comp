// Puts the entries of a piece in order, of buckets that are not short. A bucket of one piece is done then, and gets its
// cells' bits; the pieces of others are runs, left in the room of the bits, that world_merge.comp merges.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "methods/world_piece.glsl"

shared uint s_found[WORLD_PIECE];

void main() {
  if (group_number() >= totals.pieces) return;
  const WorldPiece piece = bucket_pieces[group_number()];
  const WorldBucket bucket = buckets[piece.bucket];
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  const uint first = bucket.first + piece.begin;
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS) s_found[i] = entries[first + i];
  barrier();  // all entries before they are compared
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS) {
    uint smaller = 0u;
    for (uint k = 0u; k < count; ++k) smaller += uint(s_found[k] < s_found[i]);
    s_entries[smaller] = s_found[i];
  }
  barrier();  // the order before it is read
  const bool is_long = bucket.count > WORLD_PIECE;
  for (uint i = gl_LocalInvocationIndex; i < count; i += GROUP_THREADS) {
    if (is_long)
      bits[2u * bucket.first + piece.begin + i] = s_entries[i];
    else
      entries[first + i] = s_entries[i];
  }
  if (!is_long) write_bits(bucket, 0u, count);
}
