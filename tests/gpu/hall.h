// A scene whose mirrored light is known: a mirror for a floor below a glowing ceiling, and red sky around.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace lamp::app {

/// A quad in the plane y = height, `half` its side from the middle, front up or down.
void add_quad(Scene& scene, float height, float half, bool front_up, std::uint32_t material);

/// Its camera looks at the floor alone, from 1 m above. Material 0 is the floor's, 1 the ceiling's.
[[nodiscard]] Scene hall(float half_ceiling);

}  // namespace lamp::app
