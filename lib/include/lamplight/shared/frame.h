// What a frame's passes know of the camera and the entities: matrices, size, counts.
// Promise: 256 bytes in C++ and in GLSL, so that a descriptor may begin at any view's.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_FRAME_H
#define LAMPLIGHT_SHARED_FRAME_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct Frame {
  mat4 clip_from_view;   // Vulkan clip space (y down); no shear (see view.h)
  mat4 view_from_world;  // rigid, but for `stretch`
  mat4 world_from_view;
  vec3 eye_world;         // m, world_from_view * (0,0,0)
  uint light_count;       // lights of this frame; with boxes: all entities (entity.h)
  uvec2 size_px;          // width, height
  uint box_count;         // how many of them, the last ones, are boxes: decals, then probes
  uint light_capacity;    // what there is room for, at most the plan's; shaders take no more (light_count_of)
  float stretch;          // the largest share by which view_from_world may change a length; 0: it is rigid
  uint sky_bits;          // device depth of the sky, as bits: 0.0 where depth is reversed, else 1.0
  uvec2 depth_offset_px;  // where the picture begins in the depth image
  uint view_index;        // its place among the frame's views, for shaders that draw one of several
  uint probe_count;       // how many of the boxes, the last ones, are probes
  uint cell_shift;        // Plan::cell_shift of its size: how often sides of the cells are halved; 0: as in the largest
  uint reserved;
};

#ifdef __cplusplus
static_assert(sizeof(Frame) == 256);
}  // namespace lamp::shared
#endif

#endif
