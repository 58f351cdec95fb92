// What a mask of each cell's depths says, whatever the method: by the functions of culls that keep one. In three
// dispatches: nearest and farthest keys, from a thread a pixel; their depths, from a thread a cell; the mask.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#define TILE_PX 16u  // of functions that are not called
#define BOUNDS BOUNDS_MASK
#include "common/atomic_load.glsl"
#include "common/tile_ranges.glsl"
#include "cell_mask_data.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, std430) readonly buffer CellBuffer { uint cell_of[]; };  // of each pixel
layout(set = 0, binding = 3, scalar) buffer MaskBuffer { CellMask cells[]; };
layout(push_constant) uniform Push {
  uint step_number;
  uint count;  // of cells: no more than pixels
};

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const uint number = pixel.x + frame.size_px.x * pixel.y;
  if (step_number == 1u) {
    if (number >= count) return;
    cells[number].z_near = z_view_of_key(frame, LOAD_OF_DEVICE(cells[number].nearest));
    cells[number].z_far = z_view_of_key(frame, ~LOAD_OF_DEVICE(cells[number].not_farthest));
    return;
  }
  const uint cell = cell_of[number];
  if (cell == NO_CELL) return;
  const uint key = depth_key_at(frame, depth_image, pixel, 0u);
  if (step_number == 0u) {
    atomicMax(cells[cell].nearest, key);
    atomicMax(cells[cell].not_farthest, ~key);
    return;
  }
  const float z_near = cells[cell].z_near;
  const float scale = mask_scale(z_near, cells[cell].z_far);
  atomicOr(cells[cell].mask, 1u << mask_part(z_view_of_key(frame, key), z_near, scale));
}
