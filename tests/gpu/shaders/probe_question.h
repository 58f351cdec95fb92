// What the tests of captures ask in shaders.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TESTS_PROBE_QUESTION_H
#define LAMP_TESTS_PROBE_QUESTION_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct ProbeQuestion {
  vec3 direction;
  float roughness;
  float n_dot_v;
  uint slot;
};

struct ProbeAnswer {
  vec3 radiance;
  float distance_m;
  vec2 split;
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
