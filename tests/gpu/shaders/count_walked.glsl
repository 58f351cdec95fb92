// How many lights a look-up names for a pixel at a depth before and at a depth behind everything, together.
// Needs: a look-up.
// SPDX-License-Identifier: Apache-2.0
uint count_at(uvec2 pixel, float z_view) {
  uint lights = 0u;
  uint light;
  for (Walk walk = walk_begin(pixel, z_view); walk_next(walk, light);) ++lights;
  return lights;
}

uint count_walked(uvec2 pixel) { return count_at(pixel, 1e-6) + count_at(pixel, 1e6); }
