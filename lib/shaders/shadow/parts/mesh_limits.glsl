// Limits of inverse depth on a lattice over a light's directions: what blocks of texels say, and the light's own shape.
// Needs: STEPS, CUBE_LATTICE, SPOT_LATTICE, ROUNDING, FREE; `s_limits`, `g_kind`, `g_lattice`, `g_half_width`,
// `g_range_m`; common/light_mesh.glsl, shadow/parts/radial_reach.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_MESH_LIMITS
#define LAMP_SHADOW_MESH_LIMITS

uint lattice_point(uint face, uvec2 at) {
  if (g_kind == MESH_CUBE) return cube_point(cube_face_place(face, at, CUBE_LATTICE), CUBE_LATTICE);
  return at.x + (SPOT_LATTICE + 1u) * at.y;
}

uint lattice_points() {
  return g_kind == MESH_CUBE ? cube_points(CUBE_LATTICE) : (SPOT_LATTICE + 1u) * (SPOT_LATTICE + 1u);
}

// All points of a box over depths of 1 up to a depth are lit, as far as one face can see them: limits of all lattice
// points around cells that their directions touch. Corners of the box are in the face's axes.
void limit_face(uint face, vec3 low, vec3 high, float farthest) {
  const vec2 least = max(max(low.xy, -high.xy), 0.0) / g_half_width;  // aside
  const float nearest = max(max(least.x, least.y), low.z);
  if (high.z <= 0.0 || nearest > high.z * (1.0 + ROUNDING)) return;
  vec2 first = vec2(-g_half_width);
  vec2 last = vec2(g_half_width);
  if (nearest > 0.0) {
    first = min(low.xy / nearest, low.xy / high.z);
    last = max(high.xy / nearest, high.xy / high.z);
  }
  const float per_width = 0.5 * float(g_lattice);
  const float end = float(g_lattice) - 0.5;
  const uvec2 from = uvec2(clamp((first / g_half_width + 1.0) * per_width - ROUNDING, 0.0, end));
  const uvec2 to = uvec2(clamp((last / g_half_width + 1.0) * per_width + ROUNDING, 0.0, end)) + 1u;
  const uint limit = farthest < RADIAL_UNBOUNDED ? floatBitsToUint(1.0 / (farthest * high.z)) : 0u;
  for (uint y = from.y; y <= to.y; ++y)
    for (uint x = from.x; x <= to.x; ++x) atomicMin(s_limits[lattice_point(face, uvec2(x, y))], limit);
}

// Texels a side. A block says nothing more where it is smaller than half of what it may light around itself, and each
// block goes through all lattice points around it.
uint block_size(uint light, uint least) {
  const float around = radial_taps(light) + (radial_offset(light) + MESH_SPREAD) * shadow_maps[light].scale;
  const uint wanted = 1u << findMSB(uint(clamp(0.5 * around, 1.0, float(LEAST_SQUARE / 4u))));
  return max(least, wanted);
}

void limit_block(uint light, uint square, uvec2 first, uint size) {
  const ShadowSquare texels = shadow_square(light, square);
  float stored = 1.0;
  for (uint x = 0u; x < size; ++x)
    stored = min(stored, radial_least_of_column(texels, ivec2(first) + ivec2(x, 0), int(size)));
  const RadialBox box = radial_box(light, square, vec2(first), float(size));
  const float w = radial_farthest_lit(light, radial_depth_of(light, stored));
  const float spread = 1.001 * MESH_SPREAD * radial_longest(box);
  const vec3 low = box.low - spread;
  const vec3 high = box.high + spread;
  if (g_kind == MESH_SPOT) limit_face(0u, low, high, w);
  for (uint face = 0u; g_kind == MESH_CUBE && face < 6u; ++face) {
    const vec3 a = cube_face_axes(face, low);
    const vec3 b = cube_face_axes(face, high);
    limit_face(face, min(a, b), max(a, b), w);
  }
}

// The least inverse depth at which the light's range ends in the cells around a lattice point; where a spot's circle
// touches none of them, nothing limits it.
float limit_of_shape(uint point) {
  if (g_kind == MESH_CUBE) {
    const float step = 2.0 / float(CUBE_LATTICE);
    const vec3 aside = max(abs(vec3(cube_place(point, CUBE_LATTICE)) * step - 1.0) - step, 0.0);
    return sqrt(1.0 + dot(aside, aside) - (1.0 - step) * (1.0 - step)) / g_range_m;
  }
  const float step = 2.0 * g_half_width / float(SPOT_LATTICE);
  const vec2 at = vec2(point % (SPOT_LATTICE + 1u), point / (SPOT_LATTICE + 1u));
  const vec2 aside = max(abs(at * step - g_half_width) - step, 0.0);
  if (length(aside) > g_half_width * (1.0 + ROUNDING)) return FREE / g_range_m;
  return sqrt(1.0 + dot(aside, aside)) / g_range_m;
}

#endif
