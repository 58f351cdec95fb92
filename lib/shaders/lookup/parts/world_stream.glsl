// A level's cell of world cells, walked by itself: a stream of lights that ascend.
// Needs: the buffers of lookup/world_cells.glsl.
// SPDX-License-Identifier: Apache-2.0
#define CELL_FIELD lookup_field
#define CELL_FIELD_WORD(word) lookup_bits[word]
#include "lookup/parts/cell_field.glsl"

LAMP_CONST LOOKUP_NO_LIGHT = 0xffffffffu;

// A level's cell with lights left.
struct LookupStream {
  uint light;  // the next; LOOKUP_NO_LIGHT: none is left
  uint place;  // the entry that the light's block begins with
  uint left;   // entries of the bucket from there on
  uint bits;   // lights of the block that come behind it
  uint asks;   // its brick's code, as in entries, since entries of other bricks share the bucket; and above it the cell
};

uint lookup_cell_of(LookupStream stream) { return stream.asks >> ENTRY_CODE_BITS; }

WorldBucket lookup_bucket(uint view, uint bucket) {
  return lookup_buckets[view * (LOOKUP_BUCKETS_VIEW / 2u) + bucket];
}

uint lookup_entry(uint view, uint place) { return lookup_entries[view * LOOKUP_ENTRIES_VIEW + place]; }

uint lookup_block(uint view, LookupStream stream) {
  const uint width = min(stream.left, 32u);
  const uint view_bits = view * LOOKUP_BITS_VIEW;
  if (LOOKUP_CELLS == BRICK_CELLS)
    return lookup_field(view_bits + CELL_HALVES * stream.place / 2u, lookup_cell_of(stream) * width, width);
  const uint first = view_bits + SLICE_HALVES * stream.place / 2u;
  const uint cell = lookup_cell_of(stream);
  const uint x = cell % BRICK_SLICES;
  const uint y = BRICK_SLICES + cell / BRICK_SLICES % BRICK_SLICES;
  const uint z = 2u * BRICK_SLICES + cell / (BRICK_SLICES * BRICK_SLICES);
  return lookup_field(first, x * width, width) & lookup_field(first, y * width, width) &
         lookup_field(first, z * width, width);
}

// To the stream's next light.
void lookup_advance(uint view, inout LookupStream stream) {
  uint entry = 0u;
  do {
    while (stream.bits == 0u && stream.left > 32u) {
      stream.place += 32u;
      stream.left -= 32u;
      stream.bits = lookup_block(view, stream);
    }
    stream.light = LOOKUP_NO_LIGHT;
    if (stream.bits == 0u) return;
    entry = lookup_entry(view, stream.place + LAMP_FIRST_BIT(stream.bits));
    stream.bits &= stream.bits - 1u;
  } while (code_of_entry(entry ^ stream.asks) != 0u);
  stream.light = light_of_entry(entry);
}

// Of a bucket that has lights, before the first; or with `light`, before the first that is not less.
LookupStream lookup_stream(uint view, LookupPlace place, WorldBucket bucket, uint light) {
  uint begin = 0u;
  for (uint end = light == 0u ? 0u : bucket.count; begin < end;) {
    const uint middle = (begin + end) / 2u;
    if (light_of_entry(lookup_entry(view, bucket.first + middle)) < light)
      begin = middle + 1u;
    else
      end = middle;
  }
  LookupStream stream;
  stream.light = LOOKUP_NO_LIGHT;
  stream.place = bucket.first + begin / 32u * 32u;
  stream.left = bucket.count - begin / 32u * 32u;
  stream.bits = 0u;
  stream.asks = place.cell << ENTRY_CODE_BITS | place.code;
  if (begin == bucket.count) return stream;
  stream.bits = lookup_block(view, stream) & 0xffffffffu << begin % 32u;
  return stream;
}
