// Surface reflection: GGX metallic-roughness, or Blinn-Phong, by a specialization constant.
// Based on: Khronos, glTF 2.0, appendix B; Walter et al., Microfacet Models for Refraction, EGSR (2007); Heitz,
// Understanding the Masking-Shadowing Function, JCGT 3:2 (2014); Blinn (1977), normalised as in Akenine-Moeller et al.,
// Real-Time Rendering, chapter 9.
// Promise: the same bits in every shader: nothing is left to a compiler's contraction, what may be fused says fma.
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

// What all lights have in common at a surface.
struct Reflector {
  vec3 position;  // world, m
  vec3 normal;    // unit
  vec3 to_eye;    // unit
  vec3 f0;        // reflectance where the light comes straight from above
  vec3 diffuse;   // what f0 leaves of the base colour, over pi
  float a2;       // squared alpha, which is squared roughness
  float n_eye;    // cosine between normal and to_eye
  float n_v;      // its absolute value, not 0
  float v_root;   // of the masking towards the eye
};

float fused_dot(vec3 a, vec3 b) {
  precise const float products = fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  return products;
}

// Heitz's masking has this root for the eye and for the light.
float masking_root(float cosine, float a2) {
  precise const float squared = fma(cosine * cosine, 1.0 - a2, a2);
  return sqrt(squared);
}

Reflector reflector(Surface s) {
  precise const float alpha = s.roughness * s.roughness;
  precise const vec3 f0 = fma(s.base_color - 0.04, vec3(s.metallic), vec3(0.04));
  precise const vec3 diffuse = (s.base_color / PI) * ((1.0 - s.metallic) * (1.0 - f0));
  precise const float a2 = alpha * alpha;
  const float n_eye = fused_dot(s.normal, s.to_eye);
  const float n_v = max(abs(n_eye), 1e-4);
  return Reflector(s.position, s.normal, s.to_eye, f0, diffuse, a2, n_eye, n_v, masking_root(n_v, a2));
}

// Trowbridge-Reitz distribution times height-correlated Smith masking, over 4 (n.l) (n.v).
float ggx(Reflector r, float n_h, float n_l) {
  precise const float d = fma(n_h * n_h, r.a2 - 1.0, 1.0);
  precise const float v = fma(n_l, r.v_root, r.n_v * masking_root(n_l, r.a2));
  precise const float quotient = r.a2 * (0.5 / PI) / (d * d * v);
  return quotient;
}

float blinn_phong(Reflector r, float n_h) {
  precise const float shininess = max(2.0 / r.a2 - 2.0, 1.0);
  precise const float lobe = (shininess + 8.0) / (8.0 * PI) * pow(n_h, shininess);
  return lobe;
}

// Radiance towards the eye, of a surface that faces the light (n.l > 0). `arriving`: the irradiance, n.l times what
// distance and cone leave of the light. The half vector is not made: of unit vectors it is (v + l) / sqrt(2 + 2 v.l).
vec3 reflect_light(Reflector r, float v_l, float n_l, float arriving) {
  precise const float inverse_length = inversesqrt(max(fma(v_l, 2.0, 2.0), 1e-12));
  precise const float n_h = clamp((r.n_eye + n_l) * inverse_length, 0.0, 1.0);
  precise const float grazing = clamp(1.0 - fma(v_l, inverse_length, inverse_length), 0.0, 1.0);
  precise const float grazing2 = grazing * grazing;
  precise const float g = grazing2 * grazing2 * grazing;
  precise const float specular = (BRDF == BRDF_BLINN_PHONG ? blinn_phong(r, n_h) : ggx(r, n_h, n_l)) * arriving;
  // Schlick: fresnel = f0 + (1 - f0) g, and diffuse light is what it leaves.
  precise const float grazed = specular * g;
  precise const vec3 reflected =
      fma(r.diffuse, vec3(fma(-g, arriving, arriving)), fma(r.f0, vec3(specular - grazed), vec3(grazed)));
  return reflected;
}

#endif
