// The boxes of the scene, a floor and columns on it, drawn without buffers: 36 vertices of an instance.
// SPDX-License-Identifier: Apache-2.0
struct Box {
  vec3 center;
  vec3 half_extent;
  uint material;
};

Box box_of(uint instance) {
  if (instance == 0u) return Box(vec3(0.0, -0.5, 0.0), vec3(14.0, 0.5, 14.0), 0u);
  const uint x = (instance - 1u) % 8u;
  const uint z = (instance - 1u) / 8u;
  const float height = 0.3 + 0.35 * float((x * 5u + z * 3u) % 7u);
  const float width = 0.35 + 0.05 * float((x + 2u * z) % 4u);
  return Box(vec3(3.0 * float(x) - 10.5, height, 3.0 * float(z) - 10.5), vec3(width, height, width), 1u + (x + z) % 4u);
}

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
