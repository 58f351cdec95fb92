// The lights of a pixel in the order of each walk that a look-up knows, as a hash; in GLSL and in HLSL.
// Needs: a look-up, lookup/parts/each.glsl.
// SPDX-License-Identifier: Apache-2.0

// Device depth, of pixels that are neighbours far apart; exact in any arithmetic.
float test_depth(uvec2 pixel) { return float(1u + (7u * pixel.x + 13u * pixel.y) % 127u) / 128.0; }

// FNV-1a, a light at a time.
void add_light(inout uint hash, uint light) { hash = (hash ^ (light + 1u)) * 16777619u; }

uint hash_of(Walk walk) {
  uint hash = 0u;
  uint light;
  while (walk_next(walk, light)) add_light(hash, light);
  return hash;
}

uint plain_hash(uvec2 pixel, float z_view) { return hash_of(walk_begin(pixel, z_view)); }

uint each_hash(uvec2 pixel, float z_view) {
  uint hash = 0u;
  uint light;
  LOOKUP_EACH(light, pixel, z_view) add_light(hash, light);
  return hash;
}

uint each_in_hash(uvec2 pixel, float z_view, uint first, uint end) {
  uint hash = 0u;
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first, end) add_light(hash, light);
  return hash;
}

uint few_in_hash(uvec2 pixel, float z_view, uint first, uint end) {
  uint hash = 0u;
  uint light;
  LOOKUP_FEW_IN(light, pixel, z_view, first, end) add_light(hash, light);
  return hash;
}

#ifdef LOOKUP_TOGETHER
uint taken_hash(uvec2 pixel, float z_view) {
  uint hash = 0u;
  uint light;
  Walk walk = walk_begin(pixel, z_view);
  for (;;) {
    const Walk before = walk;
    const uint count = walk_take(walk, 40u, 0u, light);
    if (count == 0u) return hash;
    for (uint rank = 0u; rank < count; ++rank) {
      Walk again = before;
      add_light(hash, walk_take(again, 40u, rank, light));
      add_light(hash, light);
    }
  }
  return hash;
}
#else
uint taken_hash(uvec2 pixel, float z_view) { return 0u; }
#endif

#ifdef LOOKUP_BY_TYPE
uint by_type_hash(uvec2 pixel, float z_view) {
  if (!walk_is_sorted(pixel, z_view)) return 0u;
  uint hash = hash_of(walk_begin_points(pixel, z_view));
  add_light(hash, hash_of(walk_begin_spots(pixel, z_view)));
  return hash;
}
#else
uint by_type_hash(uvec2 pixel, float z_view) { return 0u; }
#endif
