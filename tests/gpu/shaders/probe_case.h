// A surface among probes, and what these say there.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_PROBE_CASE_H
#define LAMP_TEST_PROBE_CASE_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct ProbeCase {
  vec3 position;
  vec3 direction;  // unit
  float distance_m;
  float nearest_m;
};

struct ProbeBlendAnswer {
  vec3 sum;  // of flat radiances, by their weights
  float weight;
  vec3 direction;  // into the first probe's capture
  float seen;
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
