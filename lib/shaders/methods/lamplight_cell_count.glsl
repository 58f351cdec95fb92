// Cells of the frame's picture, of all layers.
// Needs: TILE_PX, CELL_TILES, LAYERS; `frame`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELL_COUNT
#define LAMP_METHODS_LAMPLIGHT_CELL_COUNT
#include "common/frame.glsl"

uint cell_count() { return square_count(frame, TILE_PX * CELL_TILES) * LAYERS; }

#endif
