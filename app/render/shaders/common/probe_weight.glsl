// A frame's reflection probes, and what each weighs at a surface: by its volume, and by whether its capture sees it.
// Needs: nothing; bindings 15 and 30, constant 20.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_WEIGHT
#define LAMP_PROBE_WEIGHT
#include "common/probe_atlas.glsl"
#include "common/probe_blend.glsl"

layout(constant_id = 20) const uint PROBES = PROBES_OFF;
layout(set = 0, binding = 30, scalar) readonly buffer ProbeBuffer { ProbeData probes[]; };

float probe_weight(ProbeData p, vec3 position) {
  const float weight = probe_volume_weight(p, position);
  if (PROBES != PROBES_CAPTURED || weight == 0.0) return weight;
  const vec3 offset = position - p.capture;
  const float distance_m = length(offset);
  if (distance_m == 0.0) return weight;
  precise const float seen = weight * probe_seen(distance_m, probe_distance(p.slot, offset / distance_m));
  return seen;
}

#endif
