// A spot and a cube, for the test of one against the other.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_CONE_CASE_H
#define LAMP_TEST_CONE_CASE_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct ConeCase {
  vec3 tip;
  vec3 axis;
  float sine;  // of the half-angle
  float cosine;
  vec3 low;
  float side;
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
