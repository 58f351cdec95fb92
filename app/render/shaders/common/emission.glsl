// What surfaces emit, as far as half floats hold it: G-buffers and mirrors keep it in those, and no shading path is to show
// another picture.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_EMISSION
#define LAMP_EMISSION
#include "common/half_range.glsl"

vec3 kept_emission(vec3 emission) { return min(emission, vec3(LARGEST_HALF)); }

#endif
