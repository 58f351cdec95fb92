// The specular light of a surface's reflection probes: those of its cell, smallest first, until their weights sum to 1;
// and of that, what a mirror ray leaves to them.
// Needs: a look-up, `frame`.
// Promise: a probe whose volume does not hold the surface changes no bit, so a longer list gives the same.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBES
#define LAMP_PROBES
#include "common/boxes.glsl"
#include "common/probe_light.glsl"
#include "lookup/parts/each.glsl"

// Lists in no order: each round finds the least id that is left of those that have weight here.
void add_probes_of_any_order(inout ProbeSum sum, ProbeAsker asker, uvec2 pixel, float z_view) {
  const uint first = first_probe(frame);
  for (uint next = first; next < light_count_of(frame) && sum.weight < 1.0;) {
    uint least = light_count_of(frame);
    uint id;
    LOOKUP_FEW_IN(id, pixel, z_view, next, least) {
      if (probe_volume_weight(probes[id - first], asker.position) > 0.0) least = id;
    }
    if (least < light_count_of(frame)) add_probe(sum, asker, probes[least - first]);
    next = least + 1u;
  }
}

void add_ascending_probes(inout ProbeSum sum, ProbeAsker asker, uvec2 pixel, float z_view) {
  const uint first = first_probe(frame);
  uint id;
  LOOKUP_FEW_IN(id, pixel, z_view, first, light_count_of(frame)) {
    if (sum.weight >= 1.0) break;
    add_probe(sum, asker, probes[id - first]);
  }
}

ProbeSum light_of_probes(Surface s, Reflector r, uvec2 pixel, float z_view) {
  ProbeSum sum = ProbeSum(vec3(0.0), 0.0);
  if (PROBES == PROBES_OFF) return sum;
  const float left = left_by_mirror(s);
  if (left == 0.0) return sum;
  const ProbeAsker asker = probe_asker(s, r);
  if (BOXES_ASCEND)
    add_ascending_probes(sum, asker, pixel, z_view);
  else
    add_probes_of_any_order(sum, asker, pixel, z_view);
  leave_to_mirror(sum, left);
  return sum;
}

#endif
