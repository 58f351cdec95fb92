// Puts buckets in order. Short ones get their cells' bits: a thread for each entry, a group for the buckets that begin in
// its window of the entries. A piece of a long one has a group of its own, and becomes a run for world_merge.comp.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
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

const uint HELD = WINDOW + SHORT;  // entries of a group, at most
const uint NO_ENTRY = ~0u;         // in a long bucket's place

shared uint s_entries[HELD];  // in any order
shared uint s_ordered[HELD];
shared uint s_cells[2u * HELD + 16u];  // in order
shared uint s_bits[HELD * HALVES / 2u];
shared uint s_blocks[HELD];  // where each begins, and from these bits on how many entries it has
const uint BLOCK_COUNT_BIT = 16u;
shared uint s_block_count;
#include "methods/world_octet.glsl"

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

void order_piece(WorldPiece piece) {
  const uint threads = gl_WorkGroupSize.x;
  const WorldBucket bucket = buckets[piece.bucket];
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) s_entries[i] = entries[bucket.first + piece.begin + i];
  barrier();  // entries before they are compared
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads)
    bits[first_word(bucket.first) + piece.begin + smaller_in(0u, count, s_entries[i])] = s_entries[i];
}

uint bucket_of_entry(uint entry) {
  const LightBricks b = bricks_of(frame, spheres[light_of_entry(entry)]);
  return bucket_of(b.level, brick_of_code(b, code_of_entry(entry)), BUCKETS);
}

// Puts an entry into its bucket's order, if the bucket is short.
void order_entry(uint begin, uint i) {
  const uint entry = s_entries[i];
  if (light_of_entry(entry) >= light_count_of(frame)) return;  // what did not fit left anything in its room
  const WorldBucket own = buckets[bucket_of_entry(entry)];
  const uint at = begin + i;
  if (own.count > SHORT || at < own.first || at - own.first >= own.count) return;
  const uint bucket_begin = own.first - begin;  // in the group's entries
  const uint rank = smaller_in(bucket_begin, own.count, entry);
  s_ordered[bucket_begin + rank] = entry;
  if (rank % BLOCK == 0u)
    s_blocks[atomicAdd(s_block_count, 1u)] =
        bucket_begin + rank | min(own.count - rank, BLOCK) << BLOCK_COUNT_BIT;
}

void find_cells(uint place) {
  const uint entry = s_ordered[place];
  uvec2 cells = uvec2(0u);
  if (entry != NO_ENTRY) cells = cells_of(entry);
  s_cells[2u * place] = cells.x;
  s_cells[2u * place + 1u] = cells.y;
}

void order_window(uint window) {
  const uint threads = gl_WorkGroupSize.x;
  const uint end = min(totals.counters.entries_needed, ENTRIES);
  const uint begin = window_begin(window, end);
  const uint count = min(window_begin(window + 1u, end) - begin, HELD);  // a long bucket may be the last
  if (gl_LocalInvocationIndex == 0u) s_block_count = 0u;
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) {
    s_entries[i] = entries[begin + i];
    s_ordered[i] = NO_ENTRY;
  }
  for (uint i = gl_LocalInvocationIndex; i < first_word(count); i += threads) s_bits[i] = 0u;
  barrier();  // entries before they are compared, zeros before bits are set
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) order_entry(begin, i);
  barrier();  // the order before it is read
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads) find_cells(i);
  barrier();  // all cells before bits are made of them
  for (uint i = gl_LocalInvocationIndex; i < OCTETS * s_block_count; i += threads) {
    const uint block = s_blocks[i / OCTETS];
    write_octet(block & (1u << BLOCK_COUNT_BIT) - 1u, block >> BLOCK_COUNT_BIT, i % OCTETS);
  }
  barrier();  // all bits before they are written
  for (uint i = gl_LocalInvocationIndex; i < count; i += threads)
    if (s_ordered[i] != NO_ENTRY) entries[begin + i] = s_ordered[i];
  for (uint word = gl_LocalInvocationIndex; word < first_word(count); word += threads)
    if (s_ordered[2u * word / HALVES] != NO_ENTRY) bits[first_word(begin) + word] = s_bits[word];
}

void main() {
  if (group_number() < totals.pieces)
    order_piece(bucket_pieces[group_number()]);
  else
    order_window(group_number() - totals.pieces);
}
