// One spelling for structs that C++ and GLSL share.
// In C++ the GLSL names are aliases of glm's types. LAMP_CONST and LAMP_CONST_FLOAT declare a number for both.
// Promise: scalar layout (GL_EXT_scalar_block_layout), members of 4 bytes, so both sides see the same bytes.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_GLSL_H
#define LAMPLIGHT_SHARED_GLSL_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>

namespace lamp::shared {
using uint = std::uint32_t;
using glm::mat4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
}  // namespace lamp::shared
#define LAMP_CONST inline constexpr uint
#define LAMP_CONST_FLOAT inline constexpr float
#else
#define LAMP_CONST const uint
#define LAMP_CONST_FLOAT const float
#endif

#endif
