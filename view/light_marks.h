// Lights drawn where they are: a dot, the outline of what a point light reaches, the axis and edge of a cone. And the
// boxes of decals.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "view/gui.h"
#include "view/shown.h"

namespace lamp::app {

/// Onto the picture's rectangle of the screen, of a state that is shown; and the light that it looks at. Of very many
/// lights, the first MOST_MARKS that are in sight.
void draw_light_marks(LightMarks which, const Shown& shown, const ScreenRect& picture);
inline constexpr std::size_t MOST_MARKS = 20000;

/// The edges of the decals' boxes.
void draw_decal_boxes(const Shown& shown, const ScreenRect& picture);

/// From a box's centre to the middle of three faces.
[[nodiscard]] glm::mat3 axes_of(const shared::OrientedBox& box);

}  // namespace lamp::app
