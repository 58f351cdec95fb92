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

// The boundary band of a light: short of `near` a position is inside, beyond `far` outside. Of a spot, both hold for
// the distance and for the angle from its direction.
struct ReachLimits {
  double near_squared;  // m^2, of the distance
  double far_squared;
  double near_sin;  // of the angle
  double near_cos;
  double far_sin;
  double far_cos;
};

// The lights that surely reach a pixel: how many, and two sums of hashes of their indices, in any order.
struct PixelTruth {
  uint count;
  uint boundary;  // lights in whose boundary band the pixel lies: either answer is right
  uvec2 hash;
};

// What the walk of a pixel held.
struct Survey {
  uint visited;    // lights walked
  uint cell;       // of the look-up; SKY_CELL for sky
  uint useful;     // lights of the truth
  uint boundary;   // lights that are neither of the truth nor outside
  uint missed;     // of the truth, those that the walk did not bring; NOT_COUNTED: verify_distinct.comp counts them
  uint repeated;   // reaching lights that it brought again
  uint unordered;  // 1: a light did not ascend
  uint ended;      // 1: the device ended the walk, and there may be more lights
  uint list;       // sum of hashes of all lights walked: tells lists apart
};
LAMP_CONST NOT_COUNTED = 0xFFFFFFFFu;

#ifdef __cplusplus
static_assert(sizeof(ReachLimits) == 48 && sizeof(PixelTruth) == 16 && sizeof(Survey) == 36);
}  // namespace lamp::app::gpu
#endif

#endif
