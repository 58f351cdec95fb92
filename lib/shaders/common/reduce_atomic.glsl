// Reductions of a work group by one shared-memory atomic a thread.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.1.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_REDUCE
#define LAMP_REDUCE

shared uint s_depth_min;
shared uint s_depth_max;
shared uint s_near_half_max;
shared uint s_far_half_min;
shared uint s_depth_mask;

// Values of threads that are not `valid` are left out.
void reduce_depth(bool valid, uint bits) {
  if (!valid) return;
  atomicMin(s_depth_min, bits);
  atomicMax(s_depth_max, bits);
}

void reduce_halves(bool valid, bool near_half, uint bits) {
  if (!valid) return;
  if (near_half)
    atomicMax(s_near_half_max, bits);
  else
    atomicMin(s_far_half_min, bits);
}

void reduce_mask(uint bits) {
  if (bits != 0u) atomicOr(s_depth_mask, bits);
}

#endif
