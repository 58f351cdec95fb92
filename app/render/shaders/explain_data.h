// Which tests a light passes against the pixels of a cell.
// Promise: the same bits in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_EXPLAIN_DATA_H
#define LAMP_EXPLAIN_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// In the order in which each is sharper, or dearer, than those before it.
LAMP_CONST PASSES_SIDES = 1u;   // the planes through the cell's pixels
LAMP_CONST PASSES_DEPTHS = 2u;  // from the nearest to the farthest of its surfaces
LAMP_CONST PASSES_MASK = 4u;    // the occupied ones of 32 parts of these depths
LAMP_CONST PASSES_BOX = 8u;     // the view-space box around all that
LAMP_CONST PASSES_EXACT = 16u;  // the part of the frustum itself
LAMP_CONST PASSES_CONE = 32u;   // of a spot: its cone against spheres around the occupied parts; of a point always
LAMP_CONST PASSES_ALL = 63u;

// The pixels of a cell and how far ahead of the eye their surfaces are.
struct ExplainedCell {
  vec2 min_px;  // corners of the smallest rectangle of whole pixels
  vec2 max_px;
  float z_near;  // m
  float z_far;
  uint mask;   // of 32 equal parts of the depths, those with a surface
  uint count;  // of lights
};

// Of one light.
struct Explained {
  uint passes;  // PASSES_SIDES and so on
  uint parts;   // those of 32 that its depths meet, with a surface or without
};

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
