// Reductions of a work group: a subgroup first reduces among its own threads, then does one atomic.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 2.
// Promise: right at any subgroup size, and with any of its threads inactive.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_REDUCE
#define LAMP_REDUCE
#extension GL_KHR_shader_subgroup_arithmetic : require

shared uint s_depth_min;
shared uint s_depth_max;
shared uint s_near_half_max;
shared uint s_far_half_min;
shared uint s_depth_mask;

void reduce_depth(bool valid, uint bits) {
  const uint low = subgroupMin(valid ? bits : ~0u);
  const uint high = subgroupMax(valid ? bits : 0u);
  if (!subgroupElect()) return;
  atomicMin(s_depth_min, low);
  atomicMax(s_depth_max, high);
}

void reduce_halves(bool valid, bool near_half, uint bits) {
  const uint near_max = subgroupMax(valid && near_half ? bits : 0u);
  const uint far_min = subgroupMin(valid && !near_half ? bits : ~0u);
  if (!subgroupElect()) return;
  atomicMax(s_near_half_max, near_max);
  atomicMin(s_far_half_min, far_min);
}

void reduce_mask(uint bits) {
  const uint all_bits = subgroupOr(bits);
  if (subgroupElect()) atomicOr(s_depth_mask, all_bits);
}

#endif
