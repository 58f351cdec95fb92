// From counts to places: each bucket gets room for its entries, and long ones become pieces for the passes that follow.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

layout(local_size_x_id = 0) in;
#include "common/group_scan.glsl"
layout(constant_id = 1) const uint ENTRIES = 1;  // capacity
layout(constant_id = 2) const uint SHORT = 1;    // entries of a bucket that is not cut into pieces
layout(constant_id = 3) const uint WINDOW = 1;   // entries
layout(constant_id = 4) const uint HALVES = 4;   // of a word, for an entry's bits
layout(constant_id = 5) const uint CELLS = 64;   // of a brick
#include "methods/world_words.glsl"
layout(set = 0, binding = 0, scalar) readonly buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 1, scalar) buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 2, scalar) writeonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer WindowBuffer { uint windows[]; };

const uint HELD = 4u;  // buckets of a thread, as far apart as the group has threads: neighbours are read together

shared uint s_first;
shared uint s_piece;

uint pieces_of(uint entries) { return entries <= SHORT ? 0u : (entries + WORLD_PIECE - 1u) / WORLD_PIECE; }

// Windows that begin in the bucket, or where it ends, have the next one as their first.
void write_windows(uint first, uint room) {
  if (first >= ENTRIES) return;
  const uint next = room < ENTRIES - first ? first + room : ENTRIES;
  for (uint window = first / WINDOW + 1u; window * WINDOW <= next; ++window) windows[window] = next;
}

void write_pieces(uint bucket, uint entries, uint piece) {
  for (uint i = 0u; i < pieces_of(entries); ++i) bucket_pieces[piece + i] = WorldPiece(bucket, i * WORLD_PIECE);
}

void main() {
  const uint threads = gl_WorkGroupSize.x;
  const uint bucket = gl_WorkGroupID.x * HELD * threads + gl_LocalInvocationIndex;
  uint held[HELD];
  uint sum = 0u;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    held[k] = counts[bucket + k * threads];
    sum += room_of(held[k]);
  }
  uint total;
  uint first = group_scan(sum, total);
  if (total == 0u) {  // the same for all threads of the group
    [[unroll]] for (uint k = 0u; k < HELD; ++k) buckets[bucket + k * threads] = WorldBucket(0u, 0u);
    return;
  }
  if (gl_LocalInvocationIndex == 0u) s_first = atomicAdd(totals.counters.entries_needed, total);
  barrier();  // room before it is handed out
  first += s_first;
  uint pieces = 0u;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    const bool fits = held[k] <= ENTRIES && first <= ENTRIES - room_of(held[k]);
    buckets[bucket + k * threads] = WorldBucket(fits ? first : 0u, fits ? held[k] : WORLD_ALL);
    write_windows(first, room_of(held[k]));
    first += room_of(held[k]);
    if (!fits) {
      atomicAdd(totals.counters.overflowed_cells, CELLS);
      held[k] = 0u;
    }
    pieces += pieces_of(held[k]);
  }
  uint all_pieces;
  uint piece = group_scan(pieces, all_pieces);
  if (all_pieces == 0u) return;  // the same for all threads of the group
  if (gl_LocalInvocationIndex == 0u) s_piece = atomicAdd(totals.pieces, all_pieces);
  barrier();  // places before they are taken
  piece += s_piece;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    write_pieces(bucket + k * threads, held[k], piece);
    piece += pieces_of(held[k]);
  }
}
