// The triangles of a scene as lists of still lights are made for them: instance by instance, each mesh in its order.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lamplight/triangle_lists.h"
#include "scene/scene.h"

namespace lamp::app {

/// `painted`: decals may bend normals anywhere.
[[nodiscard]] std::vector<StillTriangle> still_surfaces(const Scene& scene, bool painted);

/// Of each instance the number of its first triangle.
[[nodiscard]] std::vector<std::uint32_t> first_triangles(const Scene& scene);

/// Radians: how far a material's normals may lean from the interpolated ones, by its texture; ANY_NORMAL: not known.
[[nodiscard]] float normal_tilt(const Scene& scene, const Material& material);

}  // namespace lamp::app
