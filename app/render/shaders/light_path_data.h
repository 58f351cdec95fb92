// The paths that move_lights.comp moves lights along (scene/light_path.h).
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_LIGHT_PATH_DATA_H
#define LAMP_LIGHT_PATH_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace lamp::app::gpu {
using namespace lamp::shared;
using glm::ivec3;
#endif

LAMP_CONST PATH_WAVES = 3u;          // bits of one axis's waves, less 1; of y two bits higher, of z four
LAMP_CONST PATH_SPHERE_STAYS = 64u;  // the light's sphere is not where the light is: it reaches everything, or nothing

struct LightPathData {
  vec3 middle;     // m
  uint waves;      // and PATH_SPHERE_STAYS
  vec3 amplitude;  // m
  ivec3 sine;      // of the phase, 30 bits behind the point
  ivec3 cosine;
  vec3 to_center;  // of the light's sphere, from the light
};

struct MoveLights {
  ivec3 sine;  // of the time, for 1, 2 and 3 waves
  ivec3 cosine;
  uint first;  // the light that the first path belongs to
  uint count;  // of paths
};

#ifdef __cplusplus
static_assert(sizeof(LightPathData) == 64 && sizeof(MoveLights) == 32);
}  // namespace lamp::app::gpu
#endif

#endif
