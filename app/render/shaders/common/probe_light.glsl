// What one reflection probe adds to a surface.
// Promise: a probe whose volume does not hold the surface changes no bit.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_LIGHT
#define LAMP_PROBE_LIGHT
#include "common/brdf.glsl"
#include "common/probe_weight.glsl"

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
