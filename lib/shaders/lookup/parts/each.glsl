// LOOKUP_EACH(light, pixel, z_view) statement: runs the statement for each light of a pixel, by the look-up's own way of
// walking, or else by the plain one. `light` is a uint that the shader has declared. Include it behind the look-up.
// SPDX-License-Identifier: Apache-2.0
#ifndef LOOKUP_EACH
#define LOOKUP_EACH(light, pixel, z_view) \
  for (Walk lookup_walk = walk_begin(pixel, z_view); walk_next(lookup_walk, light);)
#endif
