// Whether this frame has entities that are not lights: a constant, so that frames without them pay nothing.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BOXES
#define LAMP_BOXES
#include "common/box.glsl"

layout(constant_id = 13) const bool BOXES = false;
layout(constant_id = 14) const bool BOXES_ASCEND = true;  // in every list of the look-up

#endif
