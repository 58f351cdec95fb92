// What one reflection probe adds to a surface, and how much of the reflection a mirror ray leaves to all of them.
// Promise: a probe whose volume does not hold the surface changes no bit.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_LIGHT
#define LAMP_PROBE_LIGHT
#include "common/brdf.glsl"
#include "common/gbuffer.glsl"
#include "common/mirror.glsl"
#include "common/probe_weight.glsl"

// The roughness from which on no ray leaves a surface; 0: none does.
layout(constant_id = 21) const float MIRROR_LIMIT = 0.0;

// Of the reflection, 0 .. 1. Rays ask the G-buffer for the roughness, of which forward shading has more digits.
float left_by_mirror(Surface s) {
  if (MIRROR_LIMIT == 0.0) return 1.0;
  s.roughness = stored_roughness(s.roughness);
  precise const float left = 1.0 - mirror_weight_of(s, MIRROR_LIMIT);
  return left;
}

// Both the light and the weight are less. The ray will take its weight of all the ambient light away (mirror_shade.glsl),
// also of what probes stand for; with A for the ambient light, S and P for the probes' light and weight, and L for what
// the ray leaves: A (1 - L P) + L S - A (1 - L) = L (A (1 - P) + S).
void leave_to_mirror(inout ProbeSum sum, float left) {
  precise const vec3 specular = sum.specular * left;
  precise const float weight = sum.weight * left;
  sum = ProbeSum(specular, weight);
}

// What a surface asks of every probe.
struct ProbeAsker {
  vec3 position;
  vec3 reflection;  // unit
  float roughness;
  vec3 specular;  // reflected of a radiance
};

ProbeAsker probe_asker(Surface s, Reflector r) {
  precise const vec3 reflection = s.normal * (2.0 * fused_dot(s.normal, s.to_eye)) - s.to_eye;
  const vec2 split = split_sum(min(abs(r.half_n_eye) * 2.0, 1.0), s.roughness);
  precise const vec3 specular = fma(r.f0, vec3(split.x), vec3(split.y));
  return ProbeAsker(s.position, reflection, s.roughness, specular);
}

void add_probe(inout ProbeSum sum, ProbeAsker asker, ProbeData p) {
  const float weight = probe_weight(p, asker.position);
  if (weight == 0.0) return;
  vec3 radiance = p.flat_radiance;
  if (PROBES == PROBES_CAPTURED)
    radiance = probe_radiance(p.slot, probe_direction(p, asker.position, asker.reflection), asker.roughness);
  precise const vec3 reflected = radiance * asker.specular;
  add_probe_light(sum, weight, reflected);
}

#endif
