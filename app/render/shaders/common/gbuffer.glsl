// The G-buffer: base colour (sRGB 8), normal and material (2 x 32 bits), emitted radiance (half float).
// Based on: octahedral normals: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
// JCGT 3:2 (2014).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_GBUFFER
#define LAMP_GBUFFER

vec2 octahedral(vec3 n) {
  const vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  const vec2 signs = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signs;
}

vec3 from_octahedral(uint stored) {
  // unpackSnorm2x16 less its clamp, because -32768 is never stored
  const vec2 p = vec2(bitfieldExtract(int(stored), 0, 16), int(stored) >> 16) * (1.0 / 32767.0);
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  const float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}

// Of the four factors that it stores, as whoever reads them back has it. What was stored once stays as it is.
float stored_roughness(float roughness) { return max(unpackUnorm4x8(packUnorm4x8(vec4(roughness))).y, 0.045); }

uvec2 pack_surface(vec3 normal, float metallic, float roughness, float occlusion) {
  return uvec2(packSnorm2x16(octahedral(normal)), packUnorm4x8(vec4(metallic, roughness, occlusion, 0.0)));
}

#endif
