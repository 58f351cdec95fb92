// A picture of a look-up by position: how many lights it names at the points of a horizontal cut through a scene.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "image/image.h"
#include "render/point_walks.h"
#include "scene/scene.h"

namespace lamp::app {

/// Seen from above, +X to the right and +Z down, over the scene's bounds, at a height in metres. Points whose walk the
/// device ended are drawn as sky.
[[nodiscard]] LdrImage draw_point_cut(PointWalks& walks, const Box& bounds, float height_m, const std::string& title);

}  // namespace lamp::app
