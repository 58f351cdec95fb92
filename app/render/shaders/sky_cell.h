// What a pixel has instead of a look-up's cell where nothing is drawn: sky.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SKY_CELL_H
#define LAMP_SKY_CELL_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST SKY_CELL = 0xFFFFFFFFu;

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
