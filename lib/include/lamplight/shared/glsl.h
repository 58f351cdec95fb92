// One spelling for structs that C++, GLSL and HLSL share.
// In C++ the GLSL names are those of lamplight/vectors.h, in HLSL (LAMP_HLSL) macros for HLSL's. LAMP_CONST and
// LAMP_CONST_FLOAT declare a number for all. A mat4's m[c] is its column c in GLSL and in HLSL, where it is a row of a
// row_major matrix: GLSL's m * v is HLSL's mul(v, m).
// Promise: scalar layout (GL_EXT_scalar_block_layout), members of 4 bytes, so both sides see the same bytes.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_GLSL_H
#define LAMPLIGHT_SHARED_GLSL_H

#ifdef __cplusplus
#include <cstdint>

#include "../vectors.h"

namespace lamp::shared {
using uint = std::uint32_t;
using mat4 = Mat4;
using uvec2 = UVec2;
using uvec4 = UVec4;
using vec2 = Vec2;
using vec3 = Vec3;
using vec4 = Vec4;
}  // namespace lamp::shared
#define LAMP_CONST inline constexpr uint
#define LAMP_CONST_FLOAT inline constexpr float
#elif defined(LAMP_HLSL)
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define uvec2 uint2
#define uvec3 uint3
#define uvec4 uint4
#define mat4 row_major float4x4
#define LAMP_CONST static const uint
#define LAMP_CONST_FLOAT static const float
#else
#define LAMP_CONST const uint
#define LAMP_CONST_FLOAT const float
#endif

#endif
