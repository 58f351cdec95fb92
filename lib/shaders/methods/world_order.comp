// Puts buckets in order. Short ones get their cells' bits: a thread for each entry, a group for the buckets that begin in
// its window of the entries. A piece of a long one has a group of its own, and becomes a run for world_merge.comp.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

const uint MOST_THREADS = 256u;
layout(local_size_x_id = 4) in;
layout(constant_id = 1) const uint BUCKETS = 1;
layout(constant_id = 2) const uint ENTRIES = 1;  // capacity
layout(constant_id = 3) const uint SHORT = 1;    // entries of a bucket, at most; a window has the other threads
#include "methods/world_entry.glsl"

layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer WindowBuffer { uint windows[]; };
layout(set = 0, binding = 6, scalar) buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };  // and runs, in the room of theirs
layout(set = 0, binding = 8, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };

shared uint s_entries[MOST_THREADS];  // in any order
shared uint s_ordered[MOST_THREADS];
shared uint s_cells[2u * MOST_THREADS + 16u];  // in order
shared uint s_bits[2u * MOST_THREADS];
shared uvec2 s_blocks[MOST_THREADS];  // where each begins, and how many entries it has
shared uint s_block_count;
#include "methods/world_octet.glsl"

// Where the first bucket begins whose entries begin in the window, or behind it; `end`: of all entries.
uint window_begin(uint window, uint end) {
  const uint size = gl_WorkGroupSize.x - SHORT;
  if (window == 0u) return 0u;
  return window * size < end ? windows[window] : end;
}

uint smaller_in(uint bucket_begin, uint count, uint entry) {
  uint smaller = 0u;
  for (uint k = bucket_begin; k < bucket_begin + count; ++k) smaller += uint(s_entries[k] < entry);
  return smaller;
}

// A light may have several bricks in one bucket. Its first entry has the cells of all of them, the others have none, so
// that no walk meets it twice.
void add_cells(LightBricks b, uint entry, uint place, uint bucket_begin) {
  const uint light = light_of(entry);
  uint first = place;
  while (first > bucket_begin && light_of(s_ordered[first - 1u]) == light) --first;
  const uvec2 cells = cells_of(b, light, code_of(entry));
  atomicOr(s_cells[2u * first], cells.x);
  atomicOr(s_cells[2u * first + 1u], cells.y);
}

void order_piece(WorldPiece piece) {
  const uint thread = gl_LocalInvocationIndex;
  const WorldBucket bucket = buckets[piece.bucket];
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  const uint entry = thread < count ? entries[bucket.first + piece.begin + thread] : 0u;
  s_entries[thread] = entry;
  barrier();  // entries before they are compared
  if (thread < count) bits[2u * bucket.first + piece.begin + smaller_in(0u, count, entry)] = entry;
}

void order_window(uint window) {
  const uint thread = gl_LocalInvocationIndex;
  const uint end = min(totals.counters.entries_needed, ENTRIES);
  const uint begin = window_begin(window, end);
  const uint at = begin + thread;
  const bool is_read = at < window_begin(window + 1u, end);
  const uint entry = is_read ? entries[at] : 0u;
  s_entries[thread] = entry;
  [[unroll]] for (uint i = 0u; i < 2u; ++i) {
    s_cells[2u * thread + i] = 0u;
    s_bits[2u * thread + i] = 0u;
  }
  if (thread == 0u) s_block_count = 0u;
  barrier();  // entries before they are compared, zeros before bits are set

  // What did not fit left anything in its room: no bucket that did holds the place.
  bool is_own = is_read && light_of(entry) < light_count_of(frame);
  WorldBucket own = WorldBucket(0u, 0u);
  LightBricks b;
  if (is_own) {
    b = bricks_of(frame, spheres[light_of(entry)]);
    own = buckets[bucket_of(b.level, brick_of_code(b, code_of(entry)), BUCKETS)];
    is_own = own.count <= SHORT && at >= own.first && at - own.first < own.count;
  }
  const uint bucket_begin = own.first - begin;  // in the group's entries
  uint rank = 0u;
  if (is_own) {
    rank = smaller_in(bucket_begin, own.count, entry);
    s_ordered[bucket_begin + rank] = entry;
    if (rank % BLOCK == 0u)
      s_blocks[atomicAdd(s_block_count, 1u)] = uvec2(bucket_begin + rank, min(own.count - rank, BLOCK));
  }
  const uint place = bucket_begin + rank;
  barrier();  // the order before it is read
  if (is_own) add_cells(b, entry, place, bucket_begin);
  barrier();  // all cells before bits are made of them
  for (uint i = thread; i < OCTETS * s_block_count; i += gl_WorkGroupSize.x)
    write_octet(s_blocks[i / OCTETS].x, s_blocks[i / OCTETS].y, i % OCTETS);
  barrier();  // all bits before they are written
  if (!is_own) return;
  entries[begin + place] = entry;
  bits[2u * (begin + place)] = s_bits[2u * place];
  bits[2u * (begin + place) + 1u] = s_bits[2u * place + 1u];
}

void main() {
  if (group_number() < totals.pieces)
    order_piece(bucket_pieces[group_number()]);
  else
    order_window(group_number() - totals.pieces);
}
