// Standard deferred: the volume of one light, an icosahedron that encloses its bounding sphere. Lights without end, and
// such that reach around the eye, cover the screen through their back faces; depth clamping keeps those.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/light_bounds.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 3, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(location = 0) flat out uint out_light;

// Circumradius over inradius of an icosahedron is 1.2585; a little more for rounding.
const float CIRCUMSCRIBE = 1.26;
const float GOLDEN = 1.618033989;
const vec3 CORNERS[12] = vec3[](vec3(-1, GOLDEN, 0), vec3(1, GOLDEN, 0), vec3(-1, -GOLDEN, 0), vec3(1, -GOLDEN, 0),
                                vec3(0, -1, GOLDEN), vec3(0, 1, GOLDEN), vec3(0, -1, -GOLDEN), vec3(0, 1, -GOLDEN),
                                vec3(GOLDEN, 0, -1), vec3(GOLDEN, 0, 1), vec3(-GOLDEN, 0, -1), vec3(-GOLDEN, 0, 1));
// Turned about x until a corner lies on z: no corner is as deep as the centre. Of a light at the eye such corners have
// w = 0, where SwiftShader, which interpolates depth between all corners before it clips, gets depths wrong.
const vec2 TURN = vec2(0.8506508, 0.5257311);  // cosine and sine of atan(1 / GOLDEN)
const uint FACES[60] = uint[](0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7,
                              1, 8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9,
                              8, 1);
const float WHOLE_SCREEN_M = 1e6;  // beyond this a sphere's corners would lose their precision

vec3 turned(vec3 v) { return vec3(v.x, TURN.x * v.y - TURN.y * v.z, TURN.y * v.y + TURN.x * v.z); }

vec4 whole_screen(uint corner) {  // behind all surfaces
  return vec4(corner == 1u ? 3.0 : -1.0, corner == 2u ? 3.0 : -1.0, uintBitsToFloat(frame.sky_bits), 1.0);
}

void main() {
  out_light = gl_InstanceIndex;
  const LightBounds sphere = light_bounds(frame, lights[gl_InstanceIndex]);
  const uint vertex = uint(gl_VertexIndex);
  if (sphere.radius < 0.0) {
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  } else if (sphere.radius > WHOLE_SCREEN_M) {
    gl_Position = vertex < 3u ? whole_screen(vertex) : vec4(2.0, 2.0, 0.0, 1.0);
  } else {
    const vec3 corner = turned(CORNERS[FACES[vertex]]) / length(CORNERS[0]);
    gl_Position = frame.clip_from_view * vec4(sphere.center + corner * (sphere.radius * CIRCUMSCRIBE), 1.0);
  }
}
