// Which of a radial bound's finest cells directions to a box touch. The box lies around the light: a point of it minus
// the light's position.
// Based on: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3:2 (2014). In an
// octant the map of (x, y, z) is x / (x + y + z), which grows with x and falls with y and z; so the ends of a box give
// the ends of the map, and folds need no thought: every octant is looked at by itself.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_RADIAL_CELLS
#define SHADOW_RADIAL_CELLS
#include "common/radial_levels.glsl"

struct RadialCells {
  bool any;
  uvec2 first;
  uvec2 last;
};

uvec2 radial_cell(vec2 place) { return uvec2(clamp(place, 0.0, float(RADIAL_SIDE) - 0.5)); }

// `low`, `high`: in cells.
RadialCells radial_cells_between(vec2 low, vec2 high) {
  return RadialCells(true, radial_cell(low - RADIAL_ROUNDING), radial_cell(high + RADIAL_ROUNDING));
}

// A bit for each octant that the box lies in; x, y, z of octant o are negative where its bits 0, 1, 2 are set.
uint radial_octants(vec3 low, vec3 high) {
  const uvec3 positive = mix(uvec3(0u), uvec3(0x55u, 0x33u, 0x0fu), greaterThanEqual(high, vec3(0.0)));
  const uvec3 negative = mix(uvec3(0u), uvec3(0xaau, 0xccu, 0xf0u), lessThanEqual(low, vec3(0.0)));
  const uvec3 both = positive | negative;
  return both.x & both.y & both.z;
}

RadialCells radial_cells_of_octant(uint octant, vec3 low, vec3 high) {
  const vec3 side = vec3((octant & 1u) == 0u ? 1.0 : -1.0, (octant & 2u) == 0u ? 1.0 : -1.0,
                         (octant & 4u) == 0u ? 1.0 : -1.0);
  const vec3 a = max(min(low * side, high * side), 0.0);
  const vec3 b = max(low * side, high * side);
  if (any(lessThan(b, vec3(0.0)))) return RadialCells(false, uvec2(0u), uvec2(0u));
  if (all(equal(a, vec3(0.0)))) return radial_cells_between(vec2(0.0), vec2(RADIAL_SIDE));  // the light is inside
  precise const vec2 least = a.xy / vec2(a.x + b.y + b.z, b.x + a.y + b.z);
  precise const vec2 most = b.xy / vec2(b.x + a.y + a.z, a.x + b.y + a.z);
  const bool lower = side.z < 0.0;
  precise const vec2 from = (lower ? 1.0 - most.yx : least) * side.xy;
  precise const vec2 to = (lower ? 1.0 - least.yx : most) * side.xy;
  const float half_side = 0.5 * float(RADIAL_SIDE);
  return radial_cells_between((min(from, to) + 1.0) * half_side, (max(from, to) + 1.0) * half_side);
}

// Of a spot, in its own axes; `scale` as in RadialBound.
RadialCells radial_cells_of_spot(float scale, vec3 low, vec3 high) {
  if (high.z <= 0.0) return RadialCells(false, uvec2(0u), uvec2(0u));
  if (low.z <= 0.0) return radial_cells_between(vec2(0.0), vec2(RADIAL_SIDE));
  const float middle = 0.5 * float(RADIAL_SIDE);
  return radial_cells_between(middle + scale * min(low.xy / low.z, low.xy / high.z),
                              middle + scale * max(high.xy / low.z, high.xy / high.z));
}

#endif
