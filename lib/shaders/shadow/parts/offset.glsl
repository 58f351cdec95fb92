// How far a point is moved along its normal so that a surface does not cast a shadow on itself.
// A tap at a texel's centre sees the surface up to `reach` texels beside the point. The plane through the point moved by h
// along its normal is not behind what that texel holds if h >= w m / (1 - m / a): m is how much the direction to the
// texel's centre differs along the normal, at most reach / scale times the sine between the normal and the square's axis;
// a is the height of the light over the plane, over w. Nothing else is biased by slope: a planar surface then needs no
// more, and what is left over for all others is measured (lamp verify --shadows).
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_OFFSET
#define SHADOW_OFFSET
#include "shadow/parts/place.glsl"

// Texels from a place to the farthest corner of its texel's centre, and a little for corners that rasterization snaps.
LAMP_CONST_FLOAT SHADOW_TEXEL_REACH = 0.75;
// Of the sine: shading normals are bent by maps, the surface is not.
LAMP_CONST_FLOAT SHADOW_LEAST_SINE = 0.3;
// Where light grazes the plane h would grow without end, and move the point past what does shade it.
LAMP_CONST_FLOAT SHADOW_MOST_GRAZING = 2.0;
// A step of one texel in an octahedron is up to sqrt(3) times as long as in a plane across its axis.
LAMP_CONST_FLOAT SHADOW_FOLDED_STEP = 1.7320508;

float shadow_fold(uint light) { return shadow_maps[light].kind == SHADOW_OCTAHEDRON ? SHADOW_FOLDED_STEP : 1.0; }

// Metres. `axis`, `w`: of the place, as in ShadowPlace. `taps`: texels from the place to its farthest tap.
float shadow_normal_offset(uint light, vec3 axis, float w, vec3 rel, vec3 normal, float taps) {
  const float along = shadow_dot(normal, axis);
  precise const float sine = max(sqrt(max(1.0 - along * along, 0.0)), SHADOW_LEAST_SINE);
  precise const float m = (taps + SHADOW_TEXEL_REACH) * shadow_fold(light) * sine / shadow_maps[light].scale;
  precise const float a = abs(shadow_dot(normal, rel)) / w;
  precise const float grazing = 2.0 * m < a ? a / (a - m) : SHADOW_MOST_GRAZING;
  precise const float metres = w * m * grazing;
  return metres;
}

#endif
