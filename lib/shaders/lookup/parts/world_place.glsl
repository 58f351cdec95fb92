// Where a position's lights are listed: the bucket of its brick at a level, the code of their entries, and the cell.
// Needs: LOOKUP_BUCKETS, LOOKUP_CELLS; common/world_cells.glsl.
// SPDX-License-Identifier: Apache-2.0
// A position's place at a level.
struct LookupPlace {
  bool lies;  // in a brick; positions farther out than any light have none
  uint bucket;
  uint code;  // of the brick
  uint cell;  // of the brick
};

LookupPlace lookup_place(vec3 position, uint level) {
  LookupPlace place;
  place.lies = true;
  place.cell = 0u;
  vec3 brick = position * 0.0;
  if (level != WORLD_EVERYTHING) {
    const vec3 at = position * bricks_a_metre(level);
    brick = floor(at);
    // Each by itself: the maximum of what is no number and a number may be either.
    place.lies = abs(brick.x) < WORLD_FARTHEST && abs(brick.y) < WORLD_FARTHEST && abs(brick.z) < WORLD_FARTHEST;
    const float across = float(LOOKUP_CELLS);
    const vec3 inside = floor(at * across) - brick * across;  // whole numbers: at - brick alone could round up to 1
    place.cell = uint(inside.x) + LOOKUP_CELLS * (uint(inside.y) + LOOKUP_CELLS * uint(inside.z));
  }
  place.bucket = 0u;
  place.code = 0u;
  if (place.lies) {
    place.bucket = bucket_of(level, brick, LOOKUP_BUCKETS);
    place.code = brick_code(brick);
  }
  return place;
}
