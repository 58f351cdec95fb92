// The blur's nine taps along each axis: what they weigh, and the texels between them. Small squares have none to spare:
// `shadow_border` of shadow_atlas.h is four of these and one.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_BLUR_STEP
#define SHADOW_BLUR_STEP

const float BLUR_WEIGHTS[9] = float[](0.0162162162, 0.0540540541, 0.1216216216, 0.1945945946, 0.2270270270,
                                      0.1945945946, 0.1216216216, 0.0540540541, 0.0162162162);

int blur_step(int side) { return side >= 64 ? 3 : side >= 32 ? 1 : 0; }

#endif
