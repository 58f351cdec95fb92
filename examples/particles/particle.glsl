// A particle of smoke. World space, metres.
// SPDX-License-Identifier: Apache-2.0
struct Particle {
  vec3 position;
  float radius;
  float opacity;  // where it is densest
};
