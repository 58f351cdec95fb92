// A scene's triangles for rays: those of opaque and masked surfaces, in world space.
// Promise: what a masked material's image cuts out at its finest level is not there. Glass is not there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "oracle/occluders.h"
#include "scene/scene.h"

namespace lamp::app {

/// Refers to the scene, which must outlive it.
[[nodiscard]] Occluders scene_occluders(const Scene& scene);

}  // namespace lamp::app
