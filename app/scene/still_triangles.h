// The triangles of a scene that nothing passes, for occlusion worked out ahead.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lamplight/occlusion.h"
#include "scene/scene.h"

namespace lamp::app {

/// Those of opaque materials, in world space: glass and what an image cuts out hides nothing.
[[nodiscard]] std::vector<OccluderTriangle> still_triangles(const Scene& scene);

}  // namespace lamp::app
