// Surface reflection: GGX metallic-roughness, or Blinn-Phong, by a specialization constant.
// Based on: Khronos, glTF 2.0, appendix B; Walter et al., Microfacet Models for Refraction, EGSR (2007); Heitz,
// Understanding the Masking-Shadowing Function, JCGT 3:2 (2014); Blinn (1977), normalised as in Akenine-Moeller et al.,
// Real-Time Rendering, chapter 9; the surroundings: Hirvonen et al., Accurate Real-Time Specular Reflections with
// Radiance Caching, Ray Tracing Gems (2019), chapter 32.
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
  float mask_light;   // a2, times the squared n.v over a2 / (2 pi), which the masking for the light is multiplied with
  float mask_sharp;   // sharpness, times the same
};

float fused_dot(vec3 a, vec3 b) {
  precise const float products = fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  return products;
}

// Exact, so it need not be `precise`: only then NVIDIA's compiler folds it into the instruction that takes its result.
float minus(float x) { return -x; }

// Heitz's masking, of the eye and of the light, times a scale s: s sqrt(a2 + (1 - a2) cosine^2). `blunt`: s^2 a2,
// `sharp`: s^2 (1 - a2).
float masking(float cosine, float blunt, float sharp) {
  precise const float squared = fma(sharp, cosine * cosine, blunt);
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
  precise const float mask_eye = masking(n_v, a2, sharpness) * inverse;
  precise const float scale = n_v * inverse;
  precise const float mask_light = scale * scale * a2;
  precise const float mask_sharp = scale * scale * sharpness;
  return Reflector(s.position, s.normal, half_eye, f0, diffuse, a2, sharpness, half_n_eye, mask_eye, mask_light,
                   mask_sharp);
}

// Trowbridge-Reitz distribution times height-correlated Smith masking, over 4 (n.l) (n.v). `sine2`: squared, between
// normal and half vector. The distribution's 1 - (1 - a2) (n.h)^2 is a2 + (1 - a2) sine2: where a2 is small, most of it
// would cancel in 32 bits.
float ggx(Reflector r, float sine2, float n_l) {
  precise const float d = fma(sine2, r.sharpness, r.a2);
  precise const float v = fma(n_l, r.mask_eye, masking(n_l, r.mask_light, r.mask_sharp));
  precise const float quotient = 1.0 / (d * d * v);
  return quotient;
}

// -log(1 - x), whose digits a small x would lose in 1 - x: by its series.
float minus_log_of_rest(float x) {
  precise const float series = x * fma(x, fma(x, fma(x, fma(x, 0.2, 0.25), 1.0 / 3.0), 0.5), 1.0);
  precise const float direct = -log(max(1.0 - x, 1e-30));
  return x < 0.0625 ? series : direct;
}

// (n.h)^shininess, from the sine as above.
float blinn_phong(Reflector r, float sine2) {
  precise const float shininess = max(2.0 / r.a2 - 2.0, 1.0);
  precise const float lobe = (shininess + 8.0) / (8.0 * PI) * exp(-0.5 * shininess * minus_log_of_rest(sine2));
  return lobe;
}

// Radiance towards the eye, of a surface that faces the light (n.l > 0). `halfway`: half the sum of the unit vectors to
// eye and light, as long as the cosine v.h. `arriving`: the irradiance, n.l times what distance and cone leave of the
// light. What of `halfway` is across the normal has no digits to lose, however close the two are (Lagrange's identity
// with n x h says the same with a product more); a half vector below the surface counts as across all of it.
vec3 reflect_light(Reflector r, vec3 halfway, float n_l, float arriving) {
  precise const float v_h2 = max(fused_dot(halfway, halfway), 1e-12);
  precise const float inverse = inversesqrt(v_h2);
  precise const float along = max(fma(n_l, 0.5, r.half_n_eye), 0.0);
  precise const vec3 across = fma(r.normal, vec3(minus(along)), halfway);
  precise const float sine2 = min(fused_dot(across, across) * (inverse * inverse), 1.0);
  precise const float grazing = clamp(fma(minus(v_h2), inverse, 1.0), 0.0, 1.0);
  precise const float grazing2 = grazing * grazing;
  precise const float g = grazing2 * grazing2 * grazing;
  precise const float specular = BRDF == BRDF_BLINN_PHONG ? blinn_phong(r, sine2) : ggx(r, sine2, n_l);
  // Schlick: fresnel = f0 + (1 - f0) g, and diffuse light is what it leaves.
  precise const float grazed = arriving * g;
  precise const float straight = arriving - grazed;
  precise const vec3 reflected = fma(vec3(straight), fma(vec3(specular), r.f0, r.diffuse), vec3(specular * grazed));
  return reflected;
}

// The integral of specular light over all directions, where the same radiance arrives from everywhere: f0 times the
// first, and the second. Hirvonen et al.'s fit, for GGX. `x`: the cosine between normal and eye; `a`: alpha, `a2`: its
// square.
vec2 surroundings_split(float x, float a, float a2) {
  precise const float x3 = x * x * x;
  precise const float a3 = a * a2;
  precise const float bias = fma(a, fma(x, -0.755907, 1.29678), fma(x, -1.28514, 0.99044)) /
      fma(a3, fma(x3, 316.627, fma(x, 626.13, 121.563)),
          fma(a, fma(x3, 222.592, fma(x, -27.0302, 20.3225)), fma(x3, 59.4188, fma(x, 2.92338, 1.0))));
  precise const float scale = fma(a, fma(x, -9.04756, 9.0632), fma(x, 3.32707, 0.0365463)) /
      fma(a3, fma(x3, -20.2123, fma(x * x, 19.7886, 5.56589)),
          fma(a, fma(x3, 9.22949, fma(x * x, -16.3174, 9.04401)), fma(x3, -1.36772, fma(x * x, 3.59685, 1.0))));
  return vec2(scale, max(bias, 0.0));
}

// Radiance towards the eye, of a surface on which the same radiance arrives from everywhere, `irradiance` in all: the
// integral of reflect_light over all directions. Specular light is as above (Blinn-Phong takes GGX's fit too), and only a
// share of it counts; diffuse light is what f0 leaves, without the 3 % at most that Schlick's term takes of it at grazing
// angles.
vec3 reflect_surroundings(Reflector r, vec3 irradiance, float share) {
  precise const float x = min(abs(r.half_n_eye) * 2.0, 1.0);
  const vec2 split = surroundings_split(x, sqrt(r.a2), r.a2);
  precise const vec3 specular = fma(r.f0, vec3(split.x), vec3(split.y));
  precise const vec3 reflected = irradiance * fma(specular, vec3((1.0 / PI) * share), r.diffuse);
  return reflected;
}
vec3 reflect_surroundings(Reflector r, vec3 irradiance) { return reflect_surroundings(r, irradiance, 1.0); }

#endif
