// Does a sphere touch a volume of the view? Never no when it does.
// Based on: planes and depths: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.3;
// box: Arvo, A Simple Method for Box-Sphere Intersection Testing, Graphics Gems (1990).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_VOLUME_TESTS
#define LAMP_COMMON_VOLUME_TESTS
#include "lamplight/shared/light.h"

bool sphere_touches_sides(LightBounds sphere, vec4 planes[4]) {
  bool touches = sphere.radius >= 0.0;
  for (int i = 0; i < 4; ++i)
    touches = touches && dot(planes[i].xyz, sphere.center) + planes[i].w >= -sphere.radius;
  return touches;
}

bool sphere_touches_depths(LightBounds sphere, float z_near, float z_far) {
  const float z = -sphere.center.z;
  return sphere.radius >= 0.0 && z + sphere.radius >= z_near && z - sphere.radius <= z_far;
}

bool sphere_touches_box(LightBounds sphere, vec3 box_min, vec3 box_max) {
  const vec3 gap = sphere.center - clamp(sphere.center, box_min, box_max);
  return sphere.radius >= 0.0 && dot(gap, gap) <= sphere.radius * sphere.radius;
}

#endif
