// Sine and cosine of a half-angle, 0 .. pi/2 radians.
// Based on: their power series, up to pi/4; beyond, that of the other one of pi/2 less the angle.
// Promise: off by two units in the last place at most. Those of GLSL may be off by 2^-11.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_ANGLES
#define LAMP_COMMON_ANGLES

const float QUARTER_PI = 0.78539816;

// pi/2 does not fit 32 bits; the second number is what the first one has too much. Compilers would add both at once.
float to_right_angle(float angle) {
  precise const float rounded = 1.57079637 - angle;
  precise const float rest = rounded - 4.37113883e-8;
  return rest;
}

float sine_series(float x) {
  const float x2 = x * x;
  return x + x * x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 / 362880.0)));
}

float cosine_series(float x) {
  const float x2 = x * x;
  return 1.0 - x2 * (0.5 - x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0 - x2 / 3628800.0))));
}

float sine_of(float angle) { return angle <= QUARTER_PI ? sine_series(angle) : cosine_series(to_right_angle(angle)); }

// 0 for pi/2 rounded to 32 bits, which lies a little above.
float cosine_of(float angle) {
  return angle <= QUARTER_PI ? cosine_series(angle) : max(sine_series(to_right_angle(angle)), 0.0);
}

#endif
