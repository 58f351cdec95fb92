// What casts shadows: the scene's opaque and masked meshes in clusters, and the indirect draws of these.
// Promise: every triangle of an opaque or masked mesh is in one caster of each instance; glass casts none.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/gpu_scene.h"
#include "render/shaders/shadow_data.h"

namespace lamp::app {

struct ShadowCasters {
  /// Casters of one material, one behind the other; all opaque ones together.
  struct Group {
    bool masked = false;
    std::uint32_t material = 0;  ///< if masked
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  std::vector<gpu::ShadowCaster> casters;
  std::vector<gpu::ShadowDraw> draws;  ///< one for each, its triangles alone
  std::vector<Group> groups;
};

[[nodiscard]] ShadowCasters shadow_casters(const GpuScene& scene);

}  // namespace lamp::app
