// A box against a part of a tile and against a position, and what the tests say about them.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TEST_BOX_CASE_H
#define LAMP_TEST_BOX_CASE_H

#include "volume_case.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct BoxCase {
  VolumeCase tile;
  vec3 position;  // world
};

struct BoxAnswer {
  vec2 depths;  // of the tile's, at which the box may be met; x > y: none
  vec2 span;    // depths of the box
  float slack;  // m, of a position
  uint sphere_touches;
  uint may_hold;  // the position
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
