// The decals of a frame: the scene's own, then generated ones on its surfaces.
// Promise: the same seed, the same decals; decal i does not depend on how many are asked for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// `count` decals: the scene's own as far as they go, then generated ones. Throws Error when decals are to be generated
/// and the scene has no triangle to lie on.
[[nodiscard]] std::vector<Decal> place_decals(const Scene& scene, std::uint32_t count, std::uint64_t seed);

}  // namespace lamp::app
