// What a light of the scene adds at a point, and to a diffuse surface there: exactly 0 from its range on and outside of
// its cone.
// SPDX-License-Identifier: Apache-2.0
#include "host_light.h"

vec3 light_at(HostLight light, vec3 position, out vec3 to_light) {
  const vec3 way = light.position - position;
  const float distance_m = length(way);
  const float share = distance_m / light.range;
  const float window = max(1.0 - share * share * share * share, 0.0);
  to_light = way / max(distance_m, 1e-4);
  float cone = 1.0;
  if (light.outer_angle >= 0.0) {
    const float cos_outer = cos(light.outer_angle);
    cone = clamp((dot(-to_light, light.direction) - cos_outer) * 4.0, 0.0, 1.0);
  }
  return light.color * (window * cone / (distance_m * distance_m + 0.05));
}

vec3 light_on(HostLight light, vec3 position, vec3 normal) {
  vec3 to_light;
  const vec3 arrives = light_at(light, position, to_light);
  return arrives * max(dot(normal, to_light), 0.0);
}

vec3 albedo_of(uint material) {
  const vec3 albedos[5] = vec3[](vec3(0.7), vec3(0.9, 0.5, 0.4), vec3(0.4, 0.8, 0.5), vec3(0.5, 0.6, 0.9), vec3(0.9));
  return albedos[material];
}
