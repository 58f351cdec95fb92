// Draws shapes around lights.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/gui.h"
#include "view/shown.h"
#include "view/widgets.h"

namespace lamp::app {

/// Proxies and the shape of the shadow of the light that is looked at.
void draw_light_shapes(const Shown& shown, const ScreenRect& picture);
/// A part of the inspector: the squares of that light's map, and which shape is drawn.
void shadow_of_light(const Shown& shown, ViewState& state, Widgets& widgets);

}  // namespace lamp::app
