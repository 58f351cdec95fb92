// The lights of one pixel: which its walk brings, what each adds to its radiance, and which tests keep
// each in its cell.
// Promise: through the look-up, the shading code and the tests that make the picture.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/explain_data.h"

namespace lamp::app {

/// The lights that the walk of a pixel of the last frame brings, ascending; none of sky. Culls anew. `pixel`: numbered
/// row by row.
[[nodiscard]] std::vector<std::uint32_t> lights_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel);
/// Of all pixels of the last frame, 1 where the walk brings the light, else 0. Culls anew.
[[nodiscard]] std::vector<std::uint32_t> pixels_with(Renderer& renderer, Lighting& lighting, std::uint32_t light);
/// As `lights_at`, reflection probes: their places in the frame's order (Renderer::probes).
[[nodiscard]] std::vector<std::uint32_t> probes_at(Renderer& renderer, Lighting& lighting, std::uint32_t pixel);

/// How much of a surface's reflection a probe asks for: by its volume, and with what its capture sees of the surface.
struct ProbeWeight {
  float volume = 0.0F;
  float weight = 0.0F;
};
/// By the functions that shading weighs them with.
[[nodiscard]] std::vector<ProbeWeight> probe_weights(Renderer& renderer, const ShaderLibrary& shaders,
                                                     const glm::vec3& position, std::span<const std::uint32_t> probes);

struct PixelTerms {
  std::vector<glm::vec3> lights;  ///< radiance towards the eye, of each light asked for
  glm::vec3 surroundings{0.0F};   ///< of all that is no light of the frame: probes, what is emitted, and so on
  float left_by_mirror = 1.0F;    ///< of the reflection, to probes and surroundings
};
/// What a pixel's walk brings.
struct PixelEntities {
  std::span<const std::uint32_t> lights;
  std::span<const std::uint32_t> probes;  ///< as probes_at gives them
};
/// Of an opaque surface, from the G-buffer of the last frame, which is drawn first if a forward path left none.
[[nodiscard]] PixelTerms terms_at(Renderer& renderer, const ShaderLibrary& shaders, const GpuScene& scene,
                                  const LightingInfo& info, std::uint32_t pixel, const PixelEntities& walked);

/// Which of the library's tests each light passes against the cell, and which parts of its depths it lies beside.
/// `cell.count` is set.
[[nodiscard]] std::vector<gpu::Explained> explain(Renderer& renderer, const ShaderLibrary& shaders,
                                                  gpu::ExplainedCell cell, std::span<const std::uint32_t> lights);

}  // namespace lamp::app
