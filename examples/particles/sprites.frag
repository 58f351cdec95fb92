// A round soft puff with the light of its particle, for blending with what is behind.
// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) in vec2 corner;
layout(location = 1) flat in vec3 light;
layout(location = 2) flat in float opacity;
layout(location = 0) out vec4 target;  // premultiplied

void main() {
  const float inside = max(1.0 - dot(corner, corner), 0.0);
  const float alpha = opacity * inside * inside;
  target = vec4(alpha * light, alpha);
}
