// The examples' own record of a light, for C++ and GLSL. World space, metres, radians.
// SPDX-License-Identifier: Apache-2.0
#ifndef HOST_LIGHT_H
#define HOST_LIGHT_H

struct HostLight {
  vec3 position;
  float range;
  vec3 direction;
  float outer_angle;  // half-angle of a spot's cone; negative: a point light
  vec3 color;         // candela
  float reserved;
};

#endif
