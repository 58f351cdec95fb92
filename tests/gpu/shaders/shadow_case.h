// A point that a shadow look-up is asked for.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_CASE_H
#define SHADOW_CASE_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct ShadowCase {
  vec3 position;
  uint light;
  vec3 normal;
  uint seed;
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
