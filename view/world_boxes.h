// Draws cells of the world and volumes of reflection probes; says what lists hold there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/gui.h"
#include "view/shown.h"

namespace lamp::app {

void draw_world_cells(const Shown& shown, const ScreenRect& picture);
void draw_probe_boxes(const Shown& shown, const ScreenRect& picture);
/// Parts of the inspector.
void world_of_point(const Shown& shown);
void probes_of_pixel(const Shown& shown);

}  // namespace lamp::app
