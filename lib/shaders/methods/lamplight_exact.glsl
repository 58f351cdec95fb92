// By which tests a light reaches a tile in the passes that write lists, and the inputs that these look at.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_EXACT
#define LAMP_METHODS_LAMPLIGHT_EXACT
#define BOUNDS BOUNDS_MASK
#define TEST TEST_EXACT
#define SPOT SPOT_CONE_SEGMENTS
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };

#endif
