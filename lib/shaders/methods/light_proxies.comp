// One thread a light: its proxy, and its place among those that are drawn from outside or from inside.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), rasterised culling.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/light_proxy.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint CAPACITY = 1;      // lights, of each part of `drawn`
layout(constant_id = 1) const uint REACH_1024 = 0;    // how far a sample may be from a pixel's centre, pixels / 1024
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer ProxyBuffer { LightProxy proxies[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer DrawnBuffer { uint drawn[]; };  // lights, outside, then inside
layout(set = 0, binding = 4, scalar) buffer DrawBuffer { ProxyDraw draws[2]; };

void main() {
  const uint light = gl_GlobalInvocationID.x;
  if (light == 0u) {
    draws[PROXIES_OUTSIDE].vertices = PROXY_VERTICES;
    draws[PROXIES_INSIDE].vertices = PROXY_VERTICES;
  }
  if (light >= light_count_of(frame)) return;
  const LightBounds sphere = light_bounds(frame, lights[light]);
  if (sphere.radius < 0.0) return;
  const LightProxy proxy = light_proxy(frame, lights[light], sphere, float(REACH_1024) / 1024.0);
  const bool perspective = frame.clip_from_view[2][3] != 0.0;
  const bool everywhere = lights[light].range > EVERYWHERE_M;
  const uint which = everywhere || perspective && may_be_inside(proxy, projection_eye(frame)) ? PROXIES_INSIDE
                                                                                              : PROXIES_OUTSIDE;
  proxies[light] = proxy;
  // The order among them is that of arrival; bits do not depend on it.
  drawn[which * CAPACITY + atomicAdd(draws[which].instances, 1u)] = light;
}
