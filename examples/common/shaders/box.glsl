// The boxes of the scene, drawn without vertex buffers: 36 vertices of an instance.
// SPDX-License-Identifier: Apache-2.0
struct Box {
  vec3 center;
  uint material;
  vec3 half_extent;
  uint reserved;
};
layout(set = 0, binding = 0, scalar) readonly buffer BoxBuffer { Box boxes[]; };

const vec2 QUAD[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));

vec3 box_normal(uint vertex) {
  vec3 normal = vec3(0.0);
  normal[vertex / 12u] = (vertex / 6u) % 2u == 0u ? -1.0 : 1.0;
  return normal;
}

vec3 box_position(Box box, uint vertex) {
  const uint axis = vertex / 12u;
  vec3 corner = box_normal(vertex);
  corner[(axis + 1u) % 3u] = QUAD[vertex % 6u].x;
  corner[(axis + 2u) % 3u] = QUAD[vertex % 6u].y;
  return box.center + box.half_extent * corner;
}
