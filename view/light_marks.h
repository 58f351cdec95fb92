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

/// The edges of the decals' boxes, where both ends are ahead of the eye.
void draw_decal_boxes(const Shown& shown, const ScreenRect& picture);

/// Where in the picture a point of the world is seen, 0 .. 1 from its top left; nothing behind the eye.
[[nodiscard]] std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& position);

}  // namespace lamp::app
