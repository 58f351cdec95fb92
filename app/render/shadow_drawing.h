// How the squares of a shadow atlas are drawn, by the hardware's rasterizer or in compute.
// Promise: after `record` a texel of each square holds near / w of the nearest caster at its centre, 0 where there is
// none, and texels of other squares what they held.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "lamplight/shadow_atlas.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/shadow_casters.h"

namespace lamp::app {

/// What is drawn in a frame. Resources are buffers that the GPU reads.
struct ShadowJob {
  vulkan::Resource views;                          ///< shared::ShadowView of the whole atlas
  vulkan::Resource maps;                           ///< shared::ShadowMap of each light
  std::span<const ShadowSquare> squares;           ///< those of the views
  std::span<const shared::ShadowView> host_views;  ///< the same ones
  std::span<const ShadowSquare> viewports;         ///< of each view: outside of it nothing may be drawn
};

struct ShadowDrawingInfo {
  std::uint32_t atlas_size = 0;
  std::uint64_t most_views = 0;    ///< of a frame
  std::uint64_t most_squares = 0;  ///< likewise
};

/// What both have: casters, and pairs of caster and view, found in batches of views.
class ShadowDrawing {
 public:
  ShadowDrawing(const ShadowDrawing&) = delete;
  ShadowDrawing& operator=(const ShadowDrawing&) = delete;
  virtual ~ShadowDrawing() = default;

  /// Its shaders read it as one channel of floats.
  [[nodiscard]] const GpuImage& atlas() const { return atlas_; }
  void record(vulkan::Recorder& recorder, const ShadowJob& job);

 protected:
  ShadowDrawing(Context& context, const GpuScene& scene, const ShadowDrawingInfo& info, const GpuImageInfo& atlas);

  /// The pipeline that finds pairs. It reads views, casters and instances; binding 4 is `pairs_`. `more`: its other
  /// buffers.
  [[nodiscard]] vulkan::Pipeline pair_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                               const char* shader, std::initializer_list<std::uint32_t> more,
                                               std::vector<vulkan::Constant> constants = {}) const;
  /// Of the `count` views from `first_view` on; `more`: what it changes besides, or reads without having to wait.
  void record_pairs(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline, std::span<const vulkan::Bound> more,
                    const ShadowJob& job, std::uint32_t first_view, std::uint32_t count, std::uint32_t views_a_thread);

  const GpuScene& scene_;
  ShadowCasters casters_;
  std::uint32_t views_a_batch_ = 1;
  GpuImage atlas_;
  vulkan::Buffer caster_buffer_;
  vulkan::Buffer pairs_;

 private:
  /// What comes before the batches. Clears the squares, the first time all of the image.
  virtual void record_start(vulkan::Recorder& recorder, const ShadowJob& job) = 0;
  virtual void record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                            std::uint32_t count) = 0;
};

/// Throws Error for a device that cannot draw it.
[[nodiscard]] std::unique_ptr<ShadowDrawing> shadow_draws(Context& context, const ShaderLibrary& shaders,
                                                          const GpuScene& scene, const ShadowDrawingInfo& info);

/// In compute. `most_items`: blocks of large triangles that a batch gives out; what finds no room is drawn more slowly.
[[nodiscard]] std::unique_ptr<ShadowDrawing> shadow_rasterizer(Context& context, const ShaderLibrary& shaders,
                                                               const GpuScene& scene, const ShadowDrawingInfo& info,
                                                               std::uint32_t most_items);

/// At least 16 bytes, as a descriptor wants some.
[[nodiscard]] vulkan::Buffer shadow_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes,
                                           VkBufferUsageFlags usage);

}  // namespace lamp::app
