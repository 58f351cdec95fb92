// A surface, seen from somewhere and lit from somewhere, and what it reflects.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_REFLECT_CASE_H
#define LAMP_TEST_REFLECT_CASE_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct ReflectCase {
  vec3 normal;  // these three are unit vectors
  vec3 to_eye;
  vec3 to_light;
  vec3 base_color;
  float metallic;
  float roughness;
};

struct ReflectAnswer {
  vec3 of_light;         // whose irradiance is n.l
  vec3 of_surroundings;  // whose irradiance is 1
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
