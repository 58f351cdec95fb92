// Based on: ITU-R BT.709: how bright red, green and blue are, in linear light.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_LUMINANCE
#define LAMP_LUMINANCE

float luminance_of(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }

#endif
