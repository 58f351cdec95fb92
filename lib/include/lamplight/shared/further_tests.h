// What a method tests after its own test of a sphere, as bits: for the host that asks and the shaders that do.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_FURTHER_TESTS_H
#define LAMPLIGHT_SHARED_FURTHER_TESTS_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST FURTHER_RADIAL = 1u;  // lights against their radial bounds (radial.h), option occlusion=radial
LAMP_CONST FURTHER_SHAPES = 2u;  // boxes by their shape (entity.h), option boxes=shape

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
