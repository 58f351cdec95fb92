// The depths of a cell's pixels, and which of 32 equal parts of them hold a surface.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_CELL_MASK_DATA_H
#define LAMP_CELL_MASK_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST MASK_PARTS = 32u;
LAMP_CONST NO_CELL = 0xffffffffu;  // of pixels

struct CellMask {
  uint nearest;       // key of a depth
  uint not_farthest;  // complement of one: all begins as 0
  float z_near;       // m ahead
  float z_far;
  uint mask;
};

#ifdef __cplusplus
static_assert(sizeof(CellMask) == 20);
}  // namespace lamp::app::gpu
#endif

#endif
