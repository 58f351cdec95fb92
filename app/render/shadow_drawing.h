// How the squares of a shadow atlas are drawn, by the hardware's rasterizer or in compute.
// Promise: after `record` a texel of each square holds near / w of the nearest caster at its centre, 0 where there is
// none, and texels of other squares what they held.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/shadow_casters.h"

namespace lamp::app {

/// What is drawn in a frame. Resources are buffers that the GPU reads.
struct ShadowJob {
  vulkan::Resource views;  ///< shared::ShadowView
  std::uint32_t view_count = 0;
  vulkan::Resource maps;                       ///< shared::ShadowMap of each light
  std::span<const gpu::ShadowSquare> squares;  ///< those of the views
};

class ShadowDrawing {
 public:
  ShadowDrawing() = default;
  ShadowDrawing(const ShadowDrawing&) = delete;
  ShadowDrawing& operator=(const ShadowDrawing&) = delete;
  virtual ~ShadowDrawing() = default;

  /// Its shaders read it as one channel of floats.
  [[nodiscard]] virtual const GpuImage& atlas() const = 0;
  virtual void record(vulkan::Recorder& recorder, const ShadowJob& job) = 0;
};

struct ShadowDrawingInfo {
  std::uint32_t atlas_size = 0;
  std::uint64_t most_views = 0;    ///< of a frame
  std::uint64_t most_squares = 0;  ///< likewise
};

/// Throws Error for a device that cannot draw it.
[[nodiscard]] std::unique_ptr<ShadowDrawing> shadow_draws(Context& context, const ShaderLibrary& shaders,
                                                          const GpuScene& scene, const ShadowDrawingInfo& info);

/// In compute. `most_items`: blocks of large triangles that a batch gives out; what finds no room is drawn more slowly.
[[nodiscard]] std::unique_ptr<ShadowDrawing> shadow_rasterizer(Context& context, const ShaderLibrary& shaders,
                                                               const GpuScene& scene, const ShadowDrawingInfo& info,
                                                               std::uint32_t most_items);

/// How many views are drawn at once: pairs of caster and view have room for 16 MiB. With more views than that there is
/// a further batch, so nothing is lost whatever a scene has.
[[nodiscard]] std::uint32_t views_a_batch(const ShadowCasters& casters, std::uint64_t most_views);

[[nodiscard]] vulkan::Buffer shadow_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes,
                                           VkBufferUsageFlags usage);

/// Finds the pairs of caster and view of a batch; `bound` has views, casters, instances, and what is written.
void record_shadow_pairs(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline,
                         std::span<const vulkan::Bound> bound, const gpu::ShadowBatch& batch, std::uint32_t views);

}  // namespace lamp::app
