// Which surfaces mirror, how much of the mirrored light they send to the eye, and where their ray goes.
// A pixel's `mirror_weight` is the place for all that must know of it: what else stands for mirrored light (ambient
// light's specular part, a reflection probe's) counts as much as the weight leaves.
// Based on: Schlick, An Inexpensive BRDF Model for Physically-based Rendering, Eurographics (1994).
// Promise: the same bits in every shader.
// Needs: nothing; that a surface be as the G-buffer has it.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_MIRROR
#define LAMP_MIRROR
#include "common/brdf.glsl"

// 1 up to half the limit, then less, 0 from the limit on: so that no edge shows where a texture's roughness passes it.
float mirror_weight(float roughness, float limit) {
  precise const float weight = clamp(2.0 - 2.0 * roughness / limit, 0.0, 1.0);
  return limit > 0.0 ? weight : 0.0;
}

// Fresnel, as reflect_light has it where the half vector is the normal.
vec3 mirror_share(Reflector r) {
  precise const float grazing = clamp(1.0 - 2.0 * r.half_n_eye, 0.0, 1.0);
  precise const float grazing2 = grazing * grazing;
  precise const float g = grazing2 * grazing2 * grazing;
  precise const vec3 share = fma(1.0 - r.f0, vec3(g), r.f0);
  return share;
}

struct MirrorRay {
  vec3 origin;  // world, m
  vec3 direction;  // unit
};

// How far a pixel's position may be off its surface because of its coordinates, m: half a unit in the last place of their
// sum, eight times. One for a corner in the world, four for it in view space (the matrix's products, the sums of three, the
// translation), two for the position back in the world, one for the ray's own origin.
float rounded_off(vec3 position) {
  precise const float sum = abs(position.x) + abs(position.y) + abs(position.z);
  precise const float off = 8.0 * 5.9604645e-8 * sum;
  return off;
}

// Begins a little above the surface: a pixel's position is rounded, and so is what a ray meets.
MirrorRay mirror_ray(Surface s, float z_view) {
  // The first is tuned: 2e-4 still met its own surface at 30 m.
  precise const float lift = max(5e-4 * max(z_view, 1.0), rounded_off(s.position));
  precise const vec3 origin = fma(s.normal, vec3(lift), s.position);
  precise const vec3 direction = fma(s.normal, vec3(2.0 * fused_dot(s.normal, s.to_eye)), -s.to_eye);
  return MirrorRay(origin, normalize(direction));
}

// What the pixel's surface mirrors, 0 .. 1; no ray is asked for where it is 0. A normal map may turn a normal away from
// the eye: nothing is mirrored there.
float mirror_weight_of(Surface s, float limit) {
  return fused_dot(s.normal, s.to_eye) > 0.0 ? mirror_weight(s.roughness, limit) : 0.0;
}

#endif
