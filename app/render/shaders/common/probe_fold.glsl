// The mean of a capture's faces over a texel of an octahedral square: one pixel for each of evenly laid points.
// Needs: `faces`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_FOLD
#define LAMP_PROBE_FOLD
#include "common/probe_map.glsl"

const uint FOLD_POINTS = 512u;  // along a side of the square: 4 for a texel of level 0. A face has a pixel for 16 or more

// Radiance and inverse distance. `weight`: the texel's solid angle, up to a factor that all texels of a square share.
vec4 folded_faces(uvec2 texel, uint side, out float weight) {
  const uint points = FOLD_POINTS / side;
  vec4 sum = vec4(0.0);
  weight = 0.0;
  for (uint y = 0u; y < points; ++y) {
    for (uint x = 0u; x < points; ++x) {
      const vec2 place = (vec2(texel * points + uvec2(x, y)) + 0.5) * (2.0 / float(FOLD_POINTS)) - 1.0;
      const vec3 point = octahedron_point(place);
      const float inverse = inversesqrt(dot(point, point));
      const float area = inverse * inverse * inverse;
      sum += area * faces[face_pixel(point)];
      weight += area;
    }
  }
  return sum / weight;
}

#endif
