// Where a view's rays begin: a perspective's eye need not be where view space begins.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_PROJECTION_EYE
#define LAMP_COMMON_PROJECTION_EYE
#include "lamplight/shared/frame.h"

bool is_perspective(Frame frame) { return frame.clip_from_view[2][3] != 0.0; }

// Where the view's rays begin; a mesh that holds this point shows nothing but back faces. Perspective only.
vec3 projection_eye(Frame frame) {
  const mat4 m = frame.clip_from_view;
  const float z = -m[3][3] / m[2][3];
  return vec3(-(m[2][0] * z + m[3][0]) / m[0][0], -(m[2][1] * z + m[3][1]) / m[1][1], z);
}

// A depth, or that of a perspective's eye, before which nothing is seen.
float from_eye(Frame frame, float z_view) {
  return is_perspective(frame) ? max(z_view, -projection_eye(frame).z) : z_view;
}

#endif
