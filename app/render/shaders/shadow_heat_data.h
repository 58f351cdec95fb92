// What a heat map of shadows holds of a pixel in place of a number.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_HEAT_DATA_H
#define LAMP_SHADOW_HEAT_DATA_H

#include "sky_cell.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
#endif

LAMP_CONST WITHOUT_SHADOW = 0xFFFFFFFEu;       // a light in view reaches the pixel and has no map
LAMP_CONST WAITS_FOR_REDRAWING = 0xFFFFFFFDu;  // one has a map of an earlier frame, and something moved since

#ifdef __cplusplus
static_assert(WITHOUT_SHADOW < SKY_CELL);
}  // namespace lamp::app::gpu
#endif

#endif
