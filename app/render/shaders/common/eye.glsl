// The unit direction from a surface to the viewer: to the eye, or against the view direction (orthographic).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_EYE
#define LAMP_EYE
#include "lamplight/shared/frame.h"

vec3 to_eye(Frame frame, vec3 position) {
  const bool perspective = frame.clip_from_view[2][3] != 0.0;
  return perspective ? normalize(frame.eye_world - position) : normalize(frame.world_from_view[2].xyz);
}

#endif
