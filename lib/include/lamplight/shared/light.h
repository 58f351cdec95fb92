// A light as the GPU reads it, or what culling reads of it, and its 16-byte bounds.
// Based on: Khronos, KHR_lights_punctual (units, range window, cone).
// Promise: Light is 64 bytes, all others 16 bytes, in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_LIGHT_H
#define LAMPLIGHT_SHARED_LIGHT_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST LIGHT_POINT = 0u;
LAMP_CONST LIGHT_SPOT = 1u;

// What a host brings of its lights (light_layout.h).
LAMP_CONST FORM_RECORD = 0u;
LAMP_CONST FORM_POINTS = 1u;
LAMP_CONST FORM_SPOTS = 2u;

// m. A range from here on is infinite: larger than any scene, and its square is still a finite float.
LAMP_CONST_FLOAT INFINITE_RADIUS = 1e18f;
LAMP_CONST_FLOAT REACHES_NOTHING = -1e30f;  // the radius of a light that reaches nothing

// Rounding of 32-bit arithmetic, as a share of the numbers that go in: four units in the last place of the radius,
// and as many of every position that a transform adds up.
LAMP_CONST_FLOAT ROUND_RADIUS = 4e-6f;
LAMP_CONST_FLOAT ROUND_POSITION = 1e-6f;

// World space. A point light leaves the direction and the angles unread.
struct Light {
  vec3 position;      // m
  float range;        // m, >= 0; 0 reaches nothing, INFINITE_RADIUS and more reaches everything
  vec3 intensity;     // candela, linear Rec. 709: colour times intensity
  uint type;          // LIGHT_POINT or LIGHT_SPOT
  vec3 direction;     // unit length; where a spot looks
  float outer_angle;  // radians, half-angle of the cone, 0 .. pi/2; light is exactly 0 outside
  float inner_angle;  // radians, 0 .. outer_angle; full intensity inside
  float cos_outer;    // cos(outer_angle)
  float spot_scale;   // 1 / max(0.001, cos(inner_angle) - cos(outer_angle))
  float sin_outer;    // sin(outer_angle)
};

// World space. All that culling reads of a light, where nothing else is brought: its first 16 bytes.
struct LightReach {
  vec3 position;  // m
  float range;    // m, as in Light
};

// And what it reads of a spot besides.
struct LightCone {
  vec3 direction;     // unit length; where a spot looks
  float outer_angle;  // radians, as in Light; negative: a point light
};

// World space. A sphere that encloses everything the light reaches, but for rounding: all that most of the culling
// reads of a light.
struct LightSphere {
  vec3 center;   // m
  float radius;  // m; negative: the light reaches nothing
};

// View space (looks down -Z). A sphere that encloses everything the light reaches, widened by the
// rounding of 32-bit arithmetic so that no test against it can lose a light.
struct LightBounds {
  vec3 center;   // m
  float radius;  // m; negative: the light reaches nothing
};

#ifdef __cplusplus
static_assert(sizeof(Light) == 64 && sizeof(LightSphere) == 16 && sizeof(LightBounds) == 16);
static_assert(sizeof(LightReach) == 16 && sizeof(LightCone) == 16);
}  // namespace lamp::shared
#endif

#endif
