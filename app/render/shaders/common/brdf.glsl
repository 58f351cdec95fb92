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

// What all lights have in common at a surface. Constants are taken in here, because loops over lights are bound by the
// number of their instructions.
struct Reflector {
  vec3 position;      // world, m
  vec3 normal;        // unit
  vec3 half_eye;      // half the unit vector to the eye
  vec3 f0;            // reflectance where the light comes straight from above
  vec3 diffuse;       // what f0 leaves of the base colour, over pi
  float a2;           // squared alpha, which is squared roughness
  float sharpness;    // 1 - a2
  float half_n_eye;   // half the cosine between normal and eye
  float mask_eye;     // Heitz's masking for the eye over a2 / (2 pi), which n.l is multiplied with
  float mask_light2;  // squared n.v over a2 / (2 pi), which the masking for the light is multiplied with
  float mask_sharp;   // mask_light2 * sharpness
};

float fused_dot(vec3 a, vec3 b) {
  precise const float products = fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  return products;
}

// Exact, so it need not be `precise`: only then NVIDIA's compiler folds it into the instruction that takes its result.
float minus(float x) { return -x; }

// Heitz's masking, of the eye and of the light, times a scale s: s sqrt(a2 + (1 - a2) cosine^2). `scale2`: s^2,
// `sharp`: s^2 (1 - a2).
float masking(float cosine, float scale2, float sharp) {
  precise const float sine2 = fma(minus(cosine), cosine, 1.0);
  precise const float squared = fma(minus(sharp), sine2, scale2);
  return sqrt(squared);
}

Reflector reflector(Surface s) {
  precise const float alpha = s.roughness * s.roughness;
  precise const vec3 f0 = fma(s.base_color - 0.04, vec3(s.metallic), vec3(0.04));
  precise const vec3 diffuse = (s.base_color / PI) * ((1.0 - s.metallic) * (1.0 - f0));
  precise const float a2 = alpha * alpha;
  precise const float sharpness = 1.0 - a2;
  precise const vec3 half_eye = s.to_eye * 0.5;
  const float half_n_eye = fused_dot(s.normal, half_eye);
  precise const float n_v = max(abs(half_n_eye) * 2.0, 1e-4);
  precise const float inverse = 1.0 / (a2 * (0.5 / PI));
  precise const float mask_eye = masking(n_v, 1.0, sharpness) * inverse;
  precise const float mask_light = n_v * inverse;
  precise const float mask_light2 = mask_light * mask_light;
  precise const float mask_sharp = mask_light2 * sharpness;
  return Reflector(s.position, s.normal, half_eye, f0, diffuse, a2, sharpness, half_n_eye, mask_eye, mask_light2,
                   mask_sharp);
}

// Trowbridge-Reitz distribution times height-correlated Smith masking, over 4 (n.l) (n.v).
float ggx(Reflector r, float n_h, float n_l) {
  precise const float d = fma(n_h * n_h, minus(r.sharpness), 1.0);
  precise const float v = fma(n_l, r.mask_eye, masking(n_l, r.mask_light2, r.mask_sharp));
  precise const float quotient = 1.0 / (d * d * v);
  return quotient;
}

float blinn_phong(Reflector r, float n_h) {
  precise const float shininess = max(2.0 / r.a2 - 2.0, 1.0);
  precise const float lobe = (shininess + 8.0) / (8.0 * PI) * pow(n_h, shininess);
  return lobe;
}

// Radiance towards the eye, of a surface that faces the light (n.l > 0). `half_v_l`: half the cosine between eye and
// light. `arriving`: the irradiance, n.l times what distance and cone leave of the light. The half vector h is not made:
// with v.h = sqrt((1 + v.l) / 2) it is (v + l) / (2 v.h).
vec3 reflect_light(Reflector r, float half_v_l, float n_l, float arriving) {
  precise const float v_h2 = max(half_v_l + 0.5, 1e-12);
  precise const float inverse = inversesqrt(v_h2);
  precise const float n_h = clamp(fma(n_l, 0.5, r.half_n_eye) * inverse, 0.0, 1.0);
  precise const float grazing = clamp(fma(minus(v_h2), inverse, 1.0), 0.0, 1.0);
  precise const float grazing2 = grazing * grazing;
  precise const float g = grazing2 * grazing2 * grazing;
  precise const float specular = BRDF == BRDF_BLINN_PHONG ? blinn_phong(r, n_h) : ggx(r, n_h, n_l);
  // Schlick: fresnel = f0 + (1 - f0) g, and diffuse light is what it leaves.
  precise const float grazed = arriving * g;
  precise const float straight = arriving - grazed;
  precise const vec3 reflected = fma(vec3(straight), fma(vec3(specular), r.f0, r.diffuse), vec3(specular * grazed));
  return reflected;
}

#endif
