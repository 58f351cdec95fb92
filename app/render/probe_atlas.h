// The atlas of reflection probes' captures: one image with a block for each slot, and the passes that fill a block.
// Promise: a block is a function of its faces alone, bit for bit; texels around each square hold what lies across its
// edges, so bilinear taps see no seam.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "gpu/context.h"
#include "gpu/image.h"
#include "image/image.h"
#include "lamplight/vulkan.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/shaders/probe_atlas_data.h"

namespace lamp::app {

/// Where shading has it (common/probe_atlas.glsl), and what it binds.
inline constexpr std::uint32_t BINDING_PROBE_ATLAS = 15;
using ProbeBound = std::array<vulkan::Bound, 1>;

/// Adds the binding to those of a pipeline that shades with probes.
void add_probe_atlas(vulkan::PipelineInfo& pipeline);

class ProbeAtlas {
 public:
  /// Throws Error where the device has no image with so many slots. All of it is black and infinitely far, until it is
  /// filled. 0 slots: something to bind where there are no probes.
  ProbeAtlas(Context& context, const ShaderLibrary& shaders, std::uint32_t slots);

  /// That fold a capture's faces, make the source of its levels, and filter these.
  [[nodiscard]] static std::vector<vulkan::Pipeline> pipelines(const vulkan::Device& device,
                                                               const ShaderLibrary& shaders);

  [[nodiscard]] std::uint32_t slots() const { return slots_; }
  [[nodiscard]] const GpuImage& image() const { return image_; }
  /// What shading binds, and reads in its stages. Between two captures the image is always as this says: who reads it
  /// tells its tracker so (`assume`).
  [[nodiscard]] ProbeBound bound() const { return {{{BINDING_PROBE_ATLAS, image_.combined(sampler_.get())}}}; }

  /// Radiance and inverse distance of the six faces of the capture that is made, PROBE_SIDE x PROBE_SIDE each.
  [[nodiscard]] const vulkan::Buffer& faces() const { return faces_; }
  /// What its rough levels were filtered from (gpu::ProbeSource).
  [[nodiscard]] const vulkan::Buffer& sources() const { return sources_; }
  /// Folds and filters the faces into a slot's block. The recorder's tracker knows how the image was left.
  void record(vulkan::Recorder& recorder, std::uint32_t slot) const;
  /// What a slot holds of a level, without its border: radiance, and in level 0 the inverse distance as alpha. Waits.
  [[nodiscard]] HdrImage read_level(Context& context, std::uint32_t slot, std::uint32_t level) const;
  /// Texels of level 0 since the beginning that were brighter than a half float can say, and are stored as the
  /// brightest. Waits for nothing: of what has been submitted and waited for.
  [[nodiscard]] std::uint32_t clipped() const;

 private:
  [[nodiscard]] glm::uvec2 origin_of(std::uint32_t slot) const;
  void record_pass(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline, const vulkan::Buffer& from,
                   const gpu::ProbePush& push, std::uint32_t side) const;

  std::uint32_t slots_;
  std::uint32_t columns_ = 1;
  GpuImage image_;
  vulkan::OwnedSampler sampler_;
  vulkan::Buffer faces_;
  vulkan::Buffer sources_;
  vulkan::Buffer clipped_;
  vulkan::Pipeline fold_;
  vulkan::Pipeline source_;
  vulkan::Pipeline filter_;
};

}  // namespace lamp::app
