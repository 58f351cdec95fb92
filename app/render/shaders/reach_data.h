// What the GPU verifier reads and writes: limits of lights in double precision, the truth of a pixel, what a walk held.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_REACH_DATA_H
#define LAMP_REACH_DATA_H

#include "lamplight/shared/glsl.h"
#include "sky_cell.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// Where a light surely reaches: short of its boundary by the band that is not checked.
struct ReachLimits {
  double distance_squared;  // m^2; a position at less than this from the light
  double sin_squared;       // of the angle from a spot's direction that a position must be inside of
  double cos_squared;
};

// The lights that surely reach a pixel: how many, and two sums of hashes of their indices, in any order.
struct PixelTruth {
  uint count;
  uvec2 hash;
};

// What the walk of a pixel held.
struct Survey {
  uint visited;    // lights walked
  uint cell;       // of the look-up; SKY_CELL for sky
  uint useful;     // lights of the truth
  uint missed;     // of them, those that the walk did not bring
  uint repeated;   // reaching lights that it brought again
  uint unordered;  // 1: a light did not ascend
  uint list;       // sum of hashes of all lights walked: tells lists apart
};

#ifdef __cplusplus
static_assert(sizeof(ReachLimits) == 24 && sizeof(PixelTruth) == 12 && sizeof(Survey) == 28);
}  // namespace lamp::app::gpu
#endif

#endif
