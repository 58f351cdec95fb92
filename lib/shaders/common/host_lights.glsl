// Lights as a host keeps them: records, or only what culling reads of them, at any place (light_layout.h).
// Gives `frame`; host_light. Bindings 0, 1 and 3, constants 1 .. 5.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_HOST_LIGHTS
#define LAMP_COMMON_HOST_LIGHTS
#include "common/angles.glsl"
#include "common/box.glsl"
#include "common/light_bounds.glsl"

layout(constant_id = 1) const uint FORM = 0;
layout(constant_id = 2) const uint LIGHT_OFFSET = 0;  // all in 16 bytes
layout(constant_id = 3) const uint LIGHT_STRIDE = 4;
layout(constant_id = 4) const uint CONE_OFFSET = 0;
layout(constant_id = 5) const uint CONE_STRIDE = 1;

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, std430) readonly buffer HostLightBuffer { uvec4 host_lights[]; };
layout(set = 0, binding = 3, std430) readonly buffer HostConeBuffer { vec4 host_cones[]; };  // read in FORM_SPOTS alone

// Whether it is a box in records, which may have a shape (shared/entity.h).
bool host_has_shape(uint i) { return FORM == FORM_RECORD && i >= first_box(frame); }

// With all that culling reads: intensity, inner angle and scale are shading's, but for a box's.
Light host_light(uint i) {
  const uint at = LIGHT_OFFSET + i * LIGHT_STRIDE;
  const vec4 reach = uintBitsToFloat(host_lights[at]);
  Light light = Light(reach.xyz, reach.w, vec3(0.0), LIGHT_POINT, vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0.0);
  if (FORM == FORM_RECORD) {
    const bool is_spot = host_lights[at + 1u].w == LIGHT_SPOT;
    if (!is_spot && !host_has_shape(i)) return light;
    const vec4 cone = uintBitsToFloat(host_lights[at + 2u]);
    const vec4 angles = uintBitsToFloat(host_lights[at + 3u]);
    if (is_spot) light.type = LIGHT_SPOT;
    light.direction = cone.xyz;
    light.outer_angle = cone.w;
    light.inner_angle = angles.x;
    light.cos_outer = angles.y;
    light.spot_scale = angles.z;
    light.sin_outer = angles.w;
  } else if (FORM == FORM_SPOTS) {
    const vec4 cone = host_cones[CONE_OFFSET + i * CONE_STRIDE];
    if (cone.w < 0.0) return light;
    light.type = LIGHT_SPOT;
    light.direction = cone.xyz;
    light.outer_angle = cone.w;
    light.cos_outer = cosine_of(cone.w);
    light.sin_outer = sine_of(cone.w);
  }
  return light;
}

#endif
