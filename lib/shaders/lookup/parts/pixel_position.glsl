// The position of a pixel, for look-ups by position.
// SPDX-License-Identifier: Apache-2.0
// The view that a pixel's position is of, where a shader draws samples through views of their own.
#ifndef LOOKUP_POSITION_FRAME
#define LOOKUP_POSITION_FRAME(view) lookup_frames[view]
#endif
vec3 lookup_position(uint view, uvec2 pixel, float z_view) {
  return world_position(LOOKUP_POSITION_FRAME(view), vec2(pixel) + 0.5, z_view);
}
