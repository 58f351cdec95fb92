// Where the levels of a radial bound's bytes lie.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_RADIAL_LEVELS
#define LAMP_COMMON_RADIAL_LEVELS
#include "lamplight/shared/radial.h"

const float RADIAL_ROUNDING = 1e-3;  // of a cell

uint radial_side(uint level) { return RADIAL_SIDE >> level; }

// Bytes, or cells, of the levels before.
uint radial_first(uint level) {
  const uint n = radial_side(level);
  return (RADIAL_SIDE * RADIAL_SIDE - n * n) / 3u * 4u;
}

#endif
