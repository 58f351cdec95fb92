// Puts buckets in order, and makes their cells' bits: a group for the short buckets that begin in its window of the
// entries, or for a long one. A piece of one that is longer still becomes a run for world_merge.comp.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "common/atomic_load.glsl"
#include "lamplight/shared/world.h"

layout(local_size_x_id = 4) in;
layout(constant_id = 1) const uint BUCKETS = 1;
layout(constant_id = 2) const uint ENTRIES = 1;  // capacity
layout(constant_id = 3) const uint SHORT = 1;    // entries of a bucket, at most
layout(constant_id = 5) const uint WINDOW = 1;   // entries
layout(constant_id = 6) const uint HALVES = 4;   // of a word, for an entry's bits
#include "methods/world_entry.glsl"

layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer WindowBuffer { uint windows[]; };
layout(set = 0, binding = 6, scalar) buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };  // and runs, in the room of theirs
layout(set = 0, binding = 8, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };

const uint HELD = WORLD_PIECE;  // entries of a group, at most; no fewer than of a window and a short bucket
const uint NO_ENTRY = ~0u;      // in place of what is not in a bucket that the group puts in order

shared uint s_entries[HELD];
shared uint s_cells[2u * HELD + 16u];  // in order
shared uint s_bits[HELD * HALVES / 2u];
shared uint s_blocks[HELD];  // where each begins, and from these bits on how many entries it has
const uint BLOCK_COUNT_BIT = 16u;
shared uint s_block_count;
#define s_sorted s_bits  // before there are bits
#include "common/group_scan.glsl"
#include "methods/world_octet.glsl"
#include "methods/world_sort.glsl"

void clear_bits(uint count) {
  if (gl_LocalInvocationIndex == 0u) s_block_count = 0u;
  for (uint i = gl_LocalInvocationIndex; i < words_of(count); i += gl_WorkGroupSize.x) s_bits[i] = 0u;
}

// The entry of that rank in its bucket, whose place is that among the group's entries.
void place_entry(uint begin, uint place, uint entry, uvec2 cells, uint rank, uint bucket_count) {
  STORE_OF_DEVICE(entries[begin + place], entry);
  s_cells[2u * place] = cells.x;
  s_cells[2u * place + 1u] = cells.y;
  if (rank % BLOCK == 0u)
    s_blocks[atomicAdd(s_block_count, 1u)] = place | min(bucket_count - rank, BLOCK) << BLOCK_COUNT_BIT;
}

void write_bits(uint begin, uint count) {
  const uint threads = gl_WorkGroupSize.x;
  barrier();  // all cells before bits are made of them
  for (uint i = gl_LocalInvocationIndex; i < OCTETS * s_block_count; i += threads) {
    const uint block = s_blocks[i / OCTETS];
    write_octet(block & (1u << BLOCK_COUNT_BIT) - 1u, block >> BLOCK_COUNT_BIT, i % OCTETS);
  }
  barrier();  // all bits before they are written
  for (uint word = gl_LocalInvocationIndex; word < words_of(count); word += threads)
    if (s_entries[2u * word / HALVES] != NO_ENTRY) bits[first_word(begin) + word] = s_bits[word];
}

// Where the first bucket begins whose entries begin in the window, or behind it; `end`: of all entries.
uint window_begin(uint window, uint end) {
  if (window == 0u) return 0u;
  return window * WINDOW < end ? windows[window] : end;
}

uint smaller_in(uint bucket_begin, uint count, uint entry) {
  uint smaller = 0u;
  for (uint k = bucket_begin; k < bucket_begin + count; ++k) smaller += uint(s_entries[k] < entry);
  return smaller;
}

// Puts an entry into its bucket's order, if the bucket is short; says whether it is. What did not fit left anything in its
// room.
bool order_entry(uint begin, uint i) {
  const uint entry = s_entries[i];
  const uint light = light_of_entry(entry);
  if (light >= light_count_of(frame)) return false;
  const LightBricks b = bricks_of(frame, spheres[light]);
  const vec3 brick = brick_of_code(b, code_of_entry(entry));
  const WorldBucket own = buckets[bucket_of(b.level, brick, BUCKETS)];
  const uint at = begin + i;
  if (own.count > SHORT || at < own.first || at - own.first >= own.count) return false;
  const uint bucket_begin = own.first - begin;  // in the group's entries
  const uint rank = smaller_in(bucket_begin, own.count, entry);
  place_entry(begin, bucket_begin + rank, entry, cells_of(b, brick, lights[light]), rank, own.count);
  return true;
}

// Entries of a long bucket, which lie between those of short ones, another group puts in order at the same time.
void order_window(uint window) {
  const uint threads = gl_WorkGroupSize.x;
  const uint end = min(totals.counters.entries_needed, ENTRIES);
  const uint begin = window_begin(window, end);
  const uint count = min(window_begin(window + 1u, end) - begin, HELD);  // a long bucket may be the last
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) s_entries[i] = LOAD_OF_DEVICE(entries[begin + i]);
  clear_bits(count);
  barrier();  // entries before they are compared, zeros before bits are set
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads)
    if (!order_entry(begin, i)) s_entries[i] = NO_ENTRY;
  write_bits(begin, count);
}

void order_piece(WorldPiece piece) {
  const uint threads = gl_WorkGroupSize.x;
  const WorldBucket own = buckets[piece.bucket];
  const uint begin = own.first + piece.begin;
  const uint count = min(own.count - piece.begin, WORLD_PIECE);
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) s_entries[i] = LOAD_OF_DEVICE(entries[begin + i]);
  sort_entries(count);
  barrier();  // the order before it is read, and before cells and bits take the room that it took
  if (own.count > WORLD_PIECE) {
    for (uint i = gl_LocalInvocationIndex; i < count; i += threads)
      bits[first_word(own.first) + piece.begin + i] = s_entries[i];
    return;
  }
  clear_bits(count);
  barrier();  // zero blocks before there are any
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads)
    place_entry(begin, i, s_entries[i], cells_of_entry(s_entries[i]), i, count);
  write_bits(begin, count);
}

void main() {
  if (group_number() < totals.pieces)
    order_piece(bucket_pieces[group_number()]);
  else
    order_window(group_number() - totals.pieces);
}
