// Ranges of depths as half floats: no narrower than they are, however a device rounds.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_HALF_RANGE
#define LAMP_COMMON_HALF_RANGE

// Depths that a half float holds no nearer, and no farther, however it is rounded: it has eleven bits, and a device may
// make zero of what is nearer to it than HALF_ZERO. Depths of an orthographic view may be negative, behind the eye.
float infinity() { return uintBitsToFloat(0x7f800000u); }
const float LARGEST_HALF = 65504.0;
const float HALF_ZERO = 6.2e-5;
float half_below(float z) {
  return z < -0.99 * LARGEST_HALF ? -infinity() : min((z > 0.0 ? 0.999 : 1.001) * z, LARGEST_HALF) - HALF_ZERO;
}
float half_above(float z) { return -half_below(-z); }

#endif
