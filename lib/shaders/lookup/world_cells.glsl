// Look-up by position: the lights of a cell at each level that has lights, merged so that they ascend. A pixel asks by
// its own position. A bucket that did not fit means every light.
// SPDX-License-Identifier: Apache-2.0
#include "common/world_cells.glsl"
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_BUCKETS, 1);
LOOKUP_BUFFER(1, LookupBuckets, WorldBucket, lookup_buckets);
LOOKUP_BUFFER(2, LookupEntries, uint, lookup_entries);
LOOKUP_BUFFER(3, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(4, LookupLevels, uint, lookup_level_bits);  // bit l: a light is listed at level l
LOOKUP_VIEW_WORDS(1, LOOKUP_BUCKETS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_ENTRIES_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_BITS_VIEW);
LOOKUP_VIEW_WORDS(4, LOOKUP_LEVELS_VIEW);

#include "lookup/parts/pixel_position.glsl"

void lookup_prepare() {}

LAMP_CONST LOOKUP_STREAMS = WORLD_LEVELS + 1u;

// A stream is a level's cell with lights left.
struct Walk {
  uint lights[LOOKUP_STREAMS];  // the stream's next
  uint cells[LOOKUP_STREAMS];   // bucket, and the cell in its lowest bits
  uint blocks[LOOKUP_STREAMS];  // where in the bucket the block of that light begins
  uint bits[LOOKUP_STREAMS];    // lights of the block that come behind it
  uint streams;
  uint view;
  uint at;  // with `all`: the next light
  bool all;
};

#include "lookup/parts/world_place.glsl"

#define LOOKUP_CELL_WORD(word) lookup_bits[word]
#include "lookup/parts/cell_field.glsl"

uint lookup_levels(uint view) { return lookup_level_bits[view * LOOKUP_LEVELS_VIEW]; }

WorldBucket lookup_bucket(uint view, uint bucket) {
  return lookup_buckets[view * (LOOKUP_BUCKETS_VIEW / 2u) + bucket];
}

uint lookup_block(Walk walk, WorldBucket bucket, uint cell, uint block) {
  const uint first = walk.view * LOOKUP_BITS_VIEW + 2u * (bucket.first + block);
  return lookup_field(first, cell % BRICK_CELLS, min(bucket.count - block, 32u));
}

// To the stream's next light; false if there is none.
bool lookup_advance(inout Walk walk, uint stream) {
  const uint cell = walk.cells[stream];
  const WorldBucket bucket = lookup_bucket(walk.view, cell / BRICK_CELLS);
  uint block = walk.blocks[stream];
  uint bits = walk.bits[stream];
  while (bits == 0u) {
    block += 32u;
    if (block >= bucket.count) return false;
    bits = lookup_block(walk, bucket, cell, block);
  }
  const uint entry = walk.view * LOOKUP_ENTRIES_VIEW + bucket.first + block + LAMP_FIRST_BIT(bits);
  walk.lights[stream] = lookup_entries[entry] >> ENTRY_BRICK_BITS;
  walk.blocks[stream] = block;
  walk.bits[stream] = bits & (bits - 1u);
  return true;
}

// False: the level's bucket did not fit.
bool lookup_add_stream(inout Walk walk, WorldPlace place) {
  const WorldBucket bucket = lookup_bucket(walk.view, place.bucket);
  if (bucket.count == WORLD_ALL) return false;
  if (bucket.count == 0u) return true;
  const uint stream = walk.streams;
  walk.cells[stream] = place.bucket * BRICK_CELLS + place.cell;
  walk.blocks[stream] = 0u;
  walk.bits[stream] = lookup_block(walk, bucket, place.cell, 0u);
  if (lookup_advance(walk, stream)) ++walk.streams;
  return true;
}

Walk world_walk_begin(uint view, vec3 position) {
  Walk walk;
  walk.streams = 0u;
  walk.view = view;
  walk.at = 0u;
  walk.all = false;
  for (uint levels = lookup_levels(view); levels != 0u && !walk.all; levels &= levels - 1u) {
    const WorldPlace place = lookup_place(position, LAMP_FIRST_BIT(levels));
    if (place.lies) walk.all = !lookup_add_stream(walk, place);
  }
  return walk;
}
Walk world_walk_begin(vec3 position) { return world_walk_begin(LOOKUP_VIEW, position); }

uint lookup_least(Walk walk) {
  uint least = walk.lights[0];
  for (uint stream = 1u; stream < walk.streams; ++stream) least = min(least, walk.lights[stream]);
  return least;
}

// The last stream takes the place of one that has ended.
void lookup_end_stream(inout Walk walk, uint stream) {
  const uint last = --walk.streams;
  walk.lights[stream] = walk.lights[last];
  walk.cells[stream] = walk.cells[last];
  walk.blocks[stream] = walk.blocks[last];
  walk.bits[stream] = walk.bits[last];
}

// Where bricks of two levels share a bucket, two streams can name one light: both move on.
bool world_walk_next(inout Walk walk, out uint light) {
  light = walk.at;
  if (walk.all) return walk.at++ < lookup_light_count();
  if (walk.streams == 0u) return false;
  light = lookup_least(walk);
  for (uint stream = 0u; stream < walk.streams;) {
    bool has_ended = false;
    if (walk.lights[stream] == light) has_ended = !lookup_advance(walk, stream);
    if (has_ended)
      lookup_end_stream(walk, stream);
    else
      ++stream;
  }
  return true;
}

// Of a pixel: the cell at the finest level with lights, which lies in one cell of each coarser level.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uint levels = lookup_levels(view);
  if (levels == 0u) return 0u;
  const WorldPlace place = lookup_place(lookup_position(view, pixel, z_view), LAMP_FIRST_BIT(levels));
  return place.bucket * BRICK_CELLS + place.cell;
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return world_walk_begin(view, lookup_position(view, pixel, z_view));
}
bool walk_next(inout Walk walk, out uint light) { return world_walk_next(walk, light); }
#include "lookup/parts/of_view.glsl"
