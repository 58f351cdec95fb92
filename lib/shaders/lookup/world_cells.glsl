// Look-up by position: the lights of a cell at each level that has lights, merged so that they ascend. A pixel asks by
// its own position. A bucket that did not fit means every light.
// SPDX-License-Identifier: Apache-2.0
#include "common/world_cells.glsl"
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_BUCKETS, 1);
LOOKUP_CONSTANT(1, uint, LOOKUP_CELLS, 4);  // along a brick: BRICK_CELLS, or BRICK_SLICES
LOOKUP_BUFFER(1, LookupBuckets, WorldBucket, lookup_buckets);
LOOKUP_BUFFER(2, LookupEntries, uint, lookup_entries);
LOOKUP_BUFFER(3, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(4, LookupLevels, uint, lookup_level_bits);  // bit l: a light is listed at level l
LOOKUP_VIEW_WORDS(1, LOOKUP_BUCKETS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_ENTRIES_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_BITS_VIEW);
LOOKUP_VIEW_WORDS(4, LOOKUP_LEVELS_VIEW);

#include "lookup/parts/pixel_position.glsl"

#include "lookup/parts/world_place.glsl"
#include "lookup/parts/world_stream.glsl"

void lookup_prepare() {}

struct Walk {
  LookupStream streams[WORLD_STREAMS];
  uint further;        // bit l: level l has no stream,
  uint further_light;  // and this is the next of such levels
  vec3 position;
  uint view;
  uint last;  // light that was named
  uint at;    // with `all`: the next light
  bool all;
};

uint lookup_levels(uint view) { return lookup_level_bits[view * LOOKUP_LEVELS_VIEW]; }

// The least light of the levels without a stream that is not less than `light`.
uint lookup_further(Walk walk, uint light) {
  uint least = LOOKUP_NO_LIGHT;
  for (uint levels = walk.further; levels != 0u; levels &= levels - 1u) {
    const LookupPlace place = lookup_place(walk.position, LAMP_FIRST_BIT(levels));
    LookupStream stream = lookup_stream(walk.view, place, lookup_bucket(walk.view, place.bucket), light);
    lookup_advance(walk.view, stream);
    least = min(least, stream.light);
  }
  return least;
}

Walk world_walk_begin(uint view, vec3 position) {
  Walk walk;
  LAMP_UNROLL for (uint i = 0u; i < WORLD_STREAMS; ++i) {
    walk.streams[i].light = LOOKUP_NO_LIGHT;
    walk.streams[i].place = 0u;
    walk.streams[i].left = 0u;
    walk.streams[i].bits = 0u;
    walk.streams[i].asks = 0u;
  }
  walk.further = 0u;
  walk.further_light = LOOKUP_NO_LIGHT;
  walk.position = position;
  walk.view = view;
  walk.last = LOOKUP_NO_LIGHT;
  walk.at = 0u;
  walk.all = false;
  uint used = 0u;
  for (uint levels = lookup_levels(view); levels != 0u; levels &= levels - 1u) {
    const uint level = LAMP_FIRST_BIT(levels);
    const LookupPlace place = lookup_place(position, level);
    if (!place.lies) continue;
    const WorldBucket bucket = lookup_bucket(view, place.bucket);
    if (bucket.count == WORLD_ALL) walk.all = true;  // it did not fit
    if (bucket.count == 0u || walk.all) continue;
    LookupStream stream = lookup_stream(view, place, bucket, 0u);
    lookup_advance(view, stream);
    if (stream.light == LOOKUP_NO_LIGHT) continue;
    if (used == WORLD_STREAMS) walk.further |= 1u << level;
    LAMP_UNROLL for (uint i = 0u; i < WORLD_STREAMS; ++i)
      if (used == i) walk.streams[i] = stream;
    used = min(used + 1u, WORLD_STREAMS);
  }
  if (walk.further != 0u) walk.further_light = lookup_further(walk, 0u);
  return walk;
}
Walk world_walk_begin(vec3 position) { return world_walk_begin(LOOKUP_VIEW, position); }

// Where bricks of two levels share a bucket and a code, two streams can name one light: the second time it is passed over.
bool world_walk_next(inout Walk walk, out uint light) {
  light = walk.at;
  if (walk.all) return walk.at++ < lookup_light_count();
  do {
    LookupStream stream = walk.streams[0];
    uint which = 0u;
    LAMP_UNROLL for (uint i = 1u; i < WORLD_STREAMS; ++i)
      if (walk.streams[i].light < stream.light) {
        stream = walk.streams[i];
        which = i;
      }
    light = min(stream.light, walk.further_light);
    if (light == LOOKUP_NO_LIGHT) return false;
    if (light == walk.further_light) walk.further_light = lookup_further(walk, light + 1u);
    if (light == stream.light) lookup_advance(walk.view, stream);
    LAMP_UNROLL for (uint i = 0u; i < WORLD_STREAMS; ++i)
      if (which == i) walk.streams[i] = stream;
  } while (light == walk.last);
  walk.last = light;
  return true;
}

// Of a pixel: the cell at the finest level with lights, which lies in one cell of each coarser level.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uint levels = lookup_levels(view);
  if (levels == 0u) return 0u;
  const LookupPlace place = lookup_place(lookup_position(view, pixel, z_view), LAMP_FIRST_BIT(levels));
  return place.bucket * LOOKUP_CELLS * LOOKUP_CELLS * LOOKUP_CELLS + place.cell;
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return world_walk_begin(view, lookup_position(view, pixel, z_view));
}
bool walk_next(inout Walk walk, out uint light) { return world_walk_next(walk, light); }
#include "lookup/parts/of_view.glsl"
