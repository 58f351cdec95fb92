// What a shadow look-up reads, in GLSL and in HLSL, and where it lies. A shader may say SHADOW_SET, SHADOW_FIRST_BINDING
// and SHADOW_FIRST_CONSTANT before it includes the look-up: a buffer of maps, one for each light, the atlas,
// and the blurred moments of vsm and evsm (any image for the others).
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_RESOURCES
#define SHADOW_RESOURCES
#include "common/language.glsl"
#include "lamplight/shared/shadow.h"

#ifndef SHADOW_SET
#define SHADOW_SET 0
#endif
#ifndef SHADOW_FIRST_BINDING
#define SHADOW_FIRST_BINDING 11
#endif
#ifndef SHADOW_FIRST_CONSTANT
#define SHADOW_FIRST_CONSTANT 15
#endif

#ifdef LAMP_HLSL
#define ivec2 int2
[[vk::binding(SHADOW_FIRST_BINDING, SHADOW_SET)]] StructuredBuffer<ShadowMap> shadow_maps;
[[vk::binding(SHADOW_FIRST_BINDING + 1, SHADOW_SET)]] Texture2D<float4> shadow_atlas;
[[vk::binding(SHADOW_FIRST_BINDING + 2, SHADOW_SET)]] Texture2D<float4> shadow_moments;
[[vk::constant_id(SHADOW_FIRST_CONSTANT)]] const uint SHADOW_FILTER = SHADOW_OFF;
#define SHADOW_TEXEL(image, at) image.Load(int3(at, 0))
#else
#extension GL_EXT_samplerless_texture_functions : require
layout(set = SHADOW_SET, binding = SHADOW_FIRST_BINDING, scalar) readonly buffer ShadowMapBuffer {
  ShadowMap shadow_maps[];
};
layout(set = SHADOW_SET, binding = SHADOW_FIRST_BINDING + 1) uniform texture2D shadow_atlas;
layout(set = SHADOW_SET, binding = SHADOW_FIRST_BINDING + 2) uniform texture2D shadow_moments;
layout(constant_id = SHADOW_FIRST_CONSTANT) const uint SHADOW_FILTER = SHADOW_OFF;
#define SHADOW_TEXEL(image, at) texelFetch(image, at, 0)
#endif

#endif
