// Surface reflection: GGX metallic-roughness, or Blinn-Phong, by a specialization constant.
// Based on: Khronos, glTF 2.0, appendix B; Walter et al., Microfacet Models for Refraction, EGSR (2007); Heitz,
// Understanding the Masking-Shadowing Function, JCGT 3:2 (2014); Blinn (1977), normalised as in Akenine-Moeller et al.,
// Real-Time Rendering, chapter 9.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BRDF
#define LAMP_BRDF

layout(constant_id = 10) const uint BRDF = 0;  // 0 GGX, 1 Blinn-Phong
const uint BRDF_BLINN_PHONG = 1u;
const float PI = 3.14159265359;

struct Surface {
  vec3 position;  // world, m
  vec3 normal;    // unit, towards the viewer's side
  vec3 to_eye;    // unit
  vec3 base_color;
  float metallic;
  float roughness;  // perceptual, 0.045 .. 1 (below, the highlight of a point light vanishes between pixels)
  float occlusion;
};

float ggx_distribution(float n_h, float a2) {
  precise const float f = n_h * n_h * (a2 - 1.0) + 1.0;
  return a2 / (PI * f * f);
}

// Height-correlated Smith masking and shadowing, divided by 4 (n.l) (n.v).
float ggx_visibility(float n_l, float n_v, float a2) {
  precise const float v = n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2);
  return 0.5 / max(v, 1e-6);
}

// Reflected radiance per unit of irradiance on a surface that faces the light, times n.l.
vec3 reflect_light(Surface s, vec3 to_light) {
  precise const float n_l = dot(s.normal, to_light);
  if (n_l <= 0.0) return vec3(0.0);
  precise const vec3 half_sum = s.to_eye + to_light;
  precise const vec3 h = half_sum / max(length(half_sum), 1e-6);
  precise const float n_h = clamp(dot(s.normal, h), 0.0, 1.0);
  precise const float v_h = clamp(dot(s.to_eye, h), 0.0, 1.0);
  precise const float n_v = max(abs(dot(s.normal, s.to_eye)), 1e-4);

  precise const vec3 f0 = mix(vec3(0.04), s.base_color, s.metallic);
  precise const float grazing = 1.0 - v_h;
  precise const float grazing2 = grazing * grazing;
  precise const vec3 fresnel = f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing);
  precise const vec3 diffuse = (1.0 - fresnel) * (1.0 - s.metallic) * s.base_color / PI;

  precise const float alpha = s.roughness * s.roughness;
  precise float specular;
  if (BRDF == BRDF_BLINN_PHONG) {
    precise const float shininess = max(2.0 / (alpha * alpha) - 2.0, 1.0);
    specular = (shininess + 8.0) / (8.0 * PI) * pow(n_h, shininess);
  } else {
    specular = ggx_distribution(n_h, alpha * alpha) * ggx_visibility(n_l, n_v, alpha * alpha);
  }
  precise const vec3 reflected = (diffuse + fresnel * specular) * n_l;
  return reflected;
}

#endif
