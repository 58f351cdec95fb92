// Between linear light and sRGB, as formats and samplers do it.
// Based on: IEC 61966-2-1.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SRGB
#define LAMP_SRGB

vec3 linear_of_srgb(vec3 srgb) {
  return mix(pow((srgb + 0.055) / 1.055, vec3(2.4)), srgb / 12.92, lessThanEqual(srgb, vec3(0.04045)));
}

vec3 srgb_of_linear(vec3 color) {
  const vec3 c = clamp(color, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

#endif
