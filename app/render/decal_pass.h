// Decals on the deferred paths: one pass between geometry and lighting paints them into the G-buffer.
// Promise: pixels that no decal covers keep their texels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/frame_data.h"
#include "render/shader_library.h"
#include "render/targets.h"
#include "scene/decal.h"

namespace lamp::app {

/// What a pass looks up boxes with: constants and bindings of the shaders that include decals.glsl.
inline constexpr std::uint32_t CONSTANT_BOXES = 13;
inline constexpr std::uint32_t CONSTANT_BOXES_ASCEND = 14;
inline constexpr std::uint32_t BINDING_DECALS = 10;

/// Paints the decals of a plan's cells.
[[nodiscard]] vulkan::Pipeline decal_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                              const Plan& plan);

class DecalPass {
 public:
  /// For the look-up of a plan, at that picture size.
  DecalPass(const vulkan::Device& device, const ShaderLibrary& shaders, const Plan& plan, glm::uvec2 size_px);

  /// After the runner's passes: `lookup` is of the same frame.
  void record(vulkan::Recorder& recorder, const FrameData& data, const Targets& targets,
              const vulkan::BoundLookUp& lookup) const;

 private:
  GpuImage base_color_;  ///< as the geometry left them
  GpuImage surface_;
  vulkan::Pipeline pipeline_;
};

/// The GPU's records of decals.
[[nodiscard]] std::vector<gpu::DecalData> pack(std::span<const Decal> decals);
/// The boxes of records, for the oracle and for the light buffer.
[[nodiscard]] std::vector<shared::OrientedBox> boxes_of(std::span<const gpu::DecalData> decals);

}  // namespace lamp::app
