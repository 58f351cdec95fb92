// Counts work groups by their number along each axis.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 1) in;
layout(set = 0, binding = 0, scalar) buffer CountBuffer { uint counts[]; };  // all, then the largest id of each axis

void main() {
  atomicAdd(counts[0], 1u);
  atomicMax(counts[1], gl_WorkGroupID.x);
  atomicMax(counts[2], gl_WorkGroupID.y);
  atomicMax(counts[3], gl_WorkGroupID.z);
}
