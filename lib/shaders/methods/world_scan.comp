// From counts to places: each bucket gets room for its entries, and becomes pieces for the passes that follow.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

layout(local_size_x_id = 0) in;
#include "common/group_scan.glsl"
layout(constant_id = 1) const uint ENTRIES = 1;      // capacity
layout(set = 0, binding = 0, scalar) readonly buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 1, scalar) buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 2, scalar) writeonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer LongBuffer { WorldPiece long_pieces[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer WindowBuffer { uint windows[]; };

const uint HELD = 4u;  // buckets of a thread, as far apart as the group has threads: neighbours are read together

shared uint s_first;
shared uint s_piece;
shared uint s_long;

uint pieces_of(uint entries) { return entries <= WORLD_SHORT ? 0u : (entries + WORLD_PIECE - 1u) / WORLD_PIECE; }
uint long_pieces_of(uint entries) { return entries > WORLD_PIECE ? pieces_of(entries) : 0u; }

// Windows that begin in the bucket, or where it ends, have the next one as their first.
void write_windows(uint first, uint entries) {
  if (first >= ENTRIES) return;
  const uint next = entries < ENTRIES - first ? first + entries : ENTRIES;
  for (uint window = first / WORLD_WINDOW + 1u; window * WORLD_WINDOW <= next; ++window) windows[window] = next;
}

void write_pieces(uint bucket, uint entries, uint piece, uint long_piece) {
  for (uint i = 0u; i < pieces_of(entries); ++i) {
    bucket_pieces[piece + i] = WorldPiece(bucket, i * WORLD_PIECE);
    if (entries > WORLD_PIECE) long_pieces[long_piece + i] = WorldPiece(bucket, i * WORLD_PIECE);
  }
}

void main() {
  const uint threads = gl_WorkGroupSize.x;
  const uint bucket = gl_WorkGroupID.x * HELD * threads + gl_LocalInvocationIndex;
  uint held[HELD];
  uint sum = 0u;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    held[k] = counts[bucket + k * threads];
    sum += held[k];
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
  uint longs = 0u;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    const bool fits = held[k] <= ENTRIES && first <= ENTRIES - held[k];
    buckets[bucket + k * threads] = WorldBucket(fits ? first : 0u, fits ? held[k] : WORLD_ALL);
    write_windows(first, held[k]);
    first += held[k];
    if (!fits) {
      atomicAdd(totals.counters.overflowed_cells, BRICK_CELLS);
      held[k] = 0u;
    }
    pieces += pieces_of(held[k]);
    longs += long_pieces_of(held[k]);
  }
  uint all_pieces;
  uint all_longs;
  uint piece = group_scan(pieces, all_pieces);
  uint long_piece = group_scan(longs, all_longs);
  if (gl_LocalInvocationIndex == 0u) {
    s_piece = all_pieces == 0u ? 0u : atomicAdd(totals.pieces, all_pieces);
    s_long = all_longs == 0u ? 0u : atomicAdd(totals.long_pieces, all_longs);
  }
  barrier();  // places before they are taken
  piece += s_piece;
  long_piece += s_long;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    write_pieces(bucket + k * threads, held[k], piece, long_piece);
    piece += pieces_of(held[k]);
    long_piece += long_pieces_of(held[k]);
  }
}
