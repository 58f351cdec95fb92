// What shaders that draw light proxies read, and how they are specialised.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_RASTER_INPUTS
#define LAMP_METHODS_RASTER_INPUTS
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"
#include "lamplight/shared/proxy.h"

layout(constant_id = 0) const uint CAPACITY = 1;   // lights, of each part of `drawn`
layout(constant_id = 1) const uint WHICH = 0;      // of the draws: PROXIES_OUTSIDE ... CUT_INSIDE
layout(constant_id = 2) const uint RASTER_PX = 1;  // pixels the side of a raster pixel
layout(constant_id = 3) const uint TILE_PX = 8;
layout(constant_id = 4) const uint WORDS = 1;          // words a tile: light capacity / 32, rounded up
layout(constant_id = 5) const bool EXACT_PIXEL = true;  // a raster pixel is a pixel and is sampled at its centre
layout(constant_id = 6) const bool FACE_DEPTHS = true;   // corners are snapped finely enough to tell how deep a face lies

const bool INSIDE = WHICH == PROXIES_INSIDE || WHICH == CUT_INSIDE;  // the eye may be: back faces, else front faces
const bool IS_CUT = WHICH >= CUT_OUTSIDE;

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer ProxyBuffer { LightProxy proxies[]; };
layout(set = 0, binding = 3, scalar) readonly buffer DrawnBuffer { uint drawn[]; };

#endif
