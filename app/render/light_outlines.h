// Shapes around lights as the GPU has them: proxies that are rasterised, meshes and bounds that shadow maps cut.
// Promise: by the shaders' own functions; there is no second copy of them here.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/light_outline_data.h"

namespace lamp::app {

/// Of one light: three corners a triangle, world space, metres; none where nothing is known of it.
using Outline = std::vector<glm::vec3>;

/// Of a frame that was drawn. `proxies`: shared::LightProxy of each light, where a job asks for them (OUTLINE_PROXY,
/// OUTLINE_CUT); shadows know the rest (Renderer::make_reach of meshes).
[[nodiscard]] std::vector<Outline> outlines(Renderer& renderer, const ShaderLibrary& shaders, VkBuffer proxies,
                                            std::span<const gpu::OutlineJob> jobs);

}  // namespace lamp::app
