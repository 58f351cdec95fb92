// A reflection probe as shaders read it: the volume whose surfaces it lights, the one that stands for the walls that it
// shows, and where it was captured. In a frame's order: ascending volume, then as the probes were made (probe_set.h).
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_DATA_H
#define LAMP_PROBE_DATA_H

#include "lamplight/shared/entity.h"
#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// What a frame's probes show.
LAMP_CONST PROBES_OFF = 0u;       // there are none
LAMP_CONST PROBES_FLAT = 1u;      // flat_radiance in every direction, through all walls: blending alone
LAMP_CONST PROBES_CAPTURED = 2u;  // what their captures saw

struct ProbeData {
  OrientedBox volume;  // of influence; its axes are those of the parallax volume too
  vec3 parallax_center;
  vec3 parallax_half_extents;
  vec3 capture;    // world, m
  float blend;     // m, from the volume's surface inwards; 0: full weight up to it
  uint ellipsoid;  // 1: both volumes are ellipsoids, 0: boxes
  uint slot;       // its number as the probes were made
  vec3 flat_radiance;
};

#ifdef __cplusplus
static_assert(sizeof(ProbeData) == 120);
}  // namespace lamp::app::gpu
#endif

#endif
