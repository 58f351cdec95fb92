// A tile of a picture between two depths, a light, and what the volume tests say about them.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_VOLUME_CASE_H
#define LAMP_TEST_VOLUME_CASE_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
#include "lamplight/shared/light.h"
namespace lamp::shared {
#endif

LAMP_CONST TOUCHES_SIDES = 1u;
LAMP_CONST TOUCHES_DEPTHS = 2u;
LAMP_CONST TOUCHES_BOX = 4u;

struct VolumeCase {
  uint frame;   // index of the view
  vec2 min_px;  // the tile
  vec2 max_px;
  float nearest;  // device depths
  float farthest;
};

struct VolumeAnswer {
  LightBounds bounds;
  uint touches;  // TOUCHES_*
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
