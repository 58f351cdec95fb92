// A sphere against the part of a tile between two depths, or its occupied parts, exactly: the least distance of the
// centre from the cross-sections of the tile's frustum.
// Based on: convex minimisation, bounded from below by strong convexity.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_EXACT_TESTS
#define LAMP_COMMON_EXACT_TESTS
#include "common/mask_tests.glsl"
#include "common/tile_volume.glsl"

// How far x is outside the edges at a depth, and how that changes with the depth.
vec2 outside_edges(float x, vec4 edges, float z) {
  const float below = edges.x + edges.y * z - x;
  const float above = x - (edges.z + edges.w * z);
  const bool is_below = below > 0.0;
  const bool is_above = above > 0.0;
  return vec2(is_below ? below : is_above ? above : 0.0, is_below ? edges.y : is_above ? -edges.w : 0.0);
}

// Squared distance from a sphere's centre to a frustum's cross-section at a depth, with its first derivative along z and
// half its second. f(z) = (z - c)^2 + dx(z)^2 + dy(z)^2 is convex and piecewise quadratic, and f'' >= 2 everywhere.
struct Section {
  float value;
  float slope;
  float curve;
};

Section section_at(LightBounds sphere, TileSides sides, float z) {
  const float ahead = z + sphere.center.z;
  const vec2 dx = outside_edges(sphere.center.x, sides.x_edges, z);
  const vec2 dy = outside_edges(sphere.center.y, sides.y_edges, z);
  return Section(ahead * ahead + dx.x * dx.x + dy.x * dy.x, 2.0 * (ahead + dx.x * dx.y + dy.x * dy.y),
                 1.0 + dx.y * dx.y + dy.y * dy.y);
}

// No less than f anywhere in [z_near, z_far] can be, as f'' >= 2: a bound that cannot lose a light.
float least_in(Section section, float z, float z_near, float z_far) {
  const float down = clamp(z - 0.5 * section.slope, z_near, z_far) - z;
  return section.value + section.slope * down + down * down;
}

// Newton finds the piece that holds the minimum in a few steps.
bool sphere_touches_frustum(LightBounds sphere, TileSides sides, float z_near, float z_far) {
  const float radius2 = sphere.radius * sphere.radius;
  float z = clamp(-sphere.center.z, z_near, z_far);
  for (int i = 0; i < 4; ++i) {
    const Section section = section_at(sphere, sides, z);
    if (section.value <= radius2) return true;
    if (least_in(section, z, z_near, z_far) > radius2) return false;
    z = clamp(z - 0.5 * section.slope / section.curve, z_near, z_far);
  }
  return true;
}

// The depths that parts of a mask span, with a margin for rounding.
vec2 depths_of_parts(float z_mask, float step, uint parts) {
  return z_mask + step * vec2(float(findLSB(parts)) - 0.001, float(findMSB(parts)) + 1.001);
}

// The same for the occupied parts of a mask alone. f has one minimum, so that of what is occupied lies there, or at the
// nearest occupied depth on either side.
bool sphere_touches_parts(LightBounds sphere, TileSides sides, float z_mask, float step, uint parts) {
  if (parts == 0u) return false;
  const float radius2 = sphere.radius * sphere.radius;
  const vec2 depths = depths_of_parts(z_mask, step, parts);
  const float z_near = depths.x;
  const float z_far = depths.y;
  float z = clamp(-sphere.center.z, z_near, z_far);
  for (int i = 0; i < 3; ++i) {
    const Section section = section_at(sphere, sides, z);
    if (least_in(section, z, z_near, z_far) > radius2) return false;
    if (section.slope == 0.0) break;
    z = clamp(z - 0.5 * section.slope / section.curve, z_near, z_far);
  }
  const uint part = uint(clamp((z - z_mask) / step, 0.0, float(MASK_BITS - 1u)));
  const uint below = parts & ~0u >> (31u - part);
  const uint above = parts & ~0u << part;
  const float z_below = min(z, z_mask + step * (float(findMSB(below)) + 1.001));
  const float z_above = max(z, z_mask + step * (float(findLSB(above)) - 0.001));
  return (below != 0u && least_in(section_at(sphere, sides, z_below), z_below, z_near, z_below) <= radius2) ||
         (above != 0u && least_in(section_at(sphere, sides, z_above), z_above, z_above, z_far) <= radius2);
}

// A first look at the same: only at that cross-section of the occupied depths which is nearest to the sphere's centre,
// of a mask with `scale` parts a metre. It decides 79 to 98 of 100 lights and tiles with occupied parts at the light's
// depths, and these as the exact test would.
const uint APART = 0u;
const uint TOUCHES = 1u;
const uint UNDECIDED = 2u;

uint look_at_parts(LightBounds sphere, TileSides sides, float z_mask, float step, float scale, uint parts) {
  const float radius2 = sphere.radius * sphere.radius;
  const vec2 depths = depths_of_parts(z_mask, step, parts);
  const float z = clamp(-sphere.center.z, depths.x, depths.y);
  const Section section = section_at(sphere, sides, z);
  const bool apart = parts == 0u || least_in(section, z, depths.x, depths.y) > radius2;
  const bool is_end = z != -sphere.center.z;  // both are occupied
  const bool is_occupied = is_end || (parts >> mask_part(z, z_mask, scale) & 1u) != 0u;
  const bool touches = is_occupied && section.value <= radius2;
  return apart ? APART : touches ? TOUCHES : UNDECIDED;
}

#endif
