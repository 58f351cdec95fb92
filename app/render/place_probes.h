// The reflection probes of a frame: the scene's own, then generated ones in its open air.
// Promise: the same scene, count and seed, the same probes; where a generated probe is does not depend on how many are
// asked for, its size does.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/open_air.h"
#include "scene/scene.h"

namespace lamp::app {

/// `count` probes as they were made: the scene's own as far as they go, then generated ones. A generated probe's
/// parallax volume reaches to the walls, found with rays; its influence a little beyond them, or as far as a point of
/// open air lies in about four probes. Every fourth is an ellipsoid. Throws Error for a captured frame, which has no
/// surfaces around its probes.
[[nodiscard]] std::vector<Probe> place_probes(const Scene& scene, std::uint32_t count, std::uint64_t seed);

}  // namespace lamp::app
