// Texels between the taps of the blur. Small squares have none to spare: `shadow_border` of shadow_atlas.h is four of
// these and one.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_BLUR_STEP
#define SHADOW_BLUR_STEP

int blur_step(int side) { return side >= 64 ? 3 : side >= 32 ? 1 : 0; }

#endif
