// Puts short buckets in order and makes their cells' bits: a thread for each entry, a group for the buckets that begin
// in its window of the entries.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

const uint GROUP_THREADS = WORLD_WINDOW + WORLD_SHORT;
layout(local_size_x = 128) in;
layout(constant_id = 1) const uint BUCKETS = 1;
layout(constant_id = 2) const uint ENTRIES = 1;  // capacity
#include "methods/world_entry.glsl"

layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer WindowBuffer { uint windows[]; };
layout(set = 0, binding = 6, scalar) buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };

shared uint s_entries[GROUP_THREADS];  // in any order
shared uint s_cells[2u * GROUP_THREADS];  // in order

// Where the first bucket begins whose entries begin in the window, or behind it.
uint window_begin(uint window, uint end) {
  if (window == 0u) return 0u;
  return window * WORLD_WINDOW < end ? windows[window] : end;
}

// How many entries of the bucket come before the entry, and how many of them are other lights'.
uvec2 before(uint bucket_begin, uint count, uint entry) {
  uvec2 smaller = uvec2(0u);
  for (uint k = bucket_begin; k < bucket_begin + count; ++k) {
    const uint other = s_entries[k];
    smaller += uvec2(other < entry, light_of(other) < light_of(entry));
  }
  return smaller;
}

// Two words of a bucket's bits: of each cell in turn a bit for each of `count` entries.
void write_words(uint first, uint bucket_begin, uint count, uint pair) {
  uint cell = 64u * pair / count;
  uint i = 64u * pair - cell * count;
  for (uint word = 2u * pair; word < 2u * pair + 2u; ++word) {
    uint made = 0u;
    for (uint bit = 0u; bit < 32u; ++bit) {
      made |= (s_cells[2u * (bucket_begin + i) + cell / 32u] >> cell % 32u & 1u) << bit;
      ++i;
      if (i == count) {
        i = 0u;
        ++cell;
      }
    }
    bits[2u * first + word] = made;
  }
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint end = min(totals.counters.entries_needed, ENTRIES);
  const uint begin = window_begin(group_number(), end);
  const uint at = begin + thread;
  const bool is_read = at < window_begin(group_number() + 1u, end);
  const uint entry = is_read ? entries[at] : 0u;
  s_entries[thread] = entry;
  barrier();  // entries before they are compared

  // What did not fit left anything in its room: no bucket that did holds the place.
  bool is_own = is_read && light_of(entry) < light_count_of(frame);
  WorldBucket own = WorldBucket(0u, 0u);
  LightBricks b;
  if (is_own) {
    b = bricks_of(frame, spheres[light_of(entry)]);
    own = buckets[bucket_of(b.level, brick_of_code(b, code_of(entry)), BUCKETS)];
    is_own = own.count <= WORLD_SHORT && at >= own.first && at - own.first < own.count;
  }
  const uint bucket_begin = own.first - begin;  // in the group's entries
  uvec2 smaller = uvec2(0u);
  uvec2 cells = uvec2(0u);
  if (is_own) {
    smaller = before(bucket_begin, own.count, entry);
    cells = cells_of(b, light_of(entry), code_of(entry));
    // A light may have several bricks in one bucket. Its first entry has the cells of all of them, the others have none,
    // so that no walk meets it twice.
    const bool is_first = smaller.x == smaller.y;
    s_cells[2u * (bucket_begin + smaller.x)] = is_first ? cells.x : 0u;
    s_cells[2u * (bucket_begin + smaller.x) + 1u] = is_first ? cells.y : 0u;
  }
  barrier();  // the first entries' cells before those of others
  if (is_own && smaller.x != smaller.y) {
    atomicOr(s_cells[2u * (bucket_begin + smaller.y)], cells.x);
    atomicOr(s_cells[2u * (bucket_begin + smaller.y) + 1u], cells.y);
  }
  barrier();  // all cells before words are made of them
  if (!is_own) return;
  entries[own.first + smaller.x] = entry;
  write_words(own.first, bucket_begin, own.count, smaller.x);
}
