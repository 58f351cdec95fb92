// Shadow maps of a scene's lights: the atlas's image, what is drawn into it each frame, and what shading reads.
// Promise: the library's atlas decides, the GPU finds which casters each square shows; a batch of views is one indirect
// draw for all opaque casters and one for each masked material.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lamplight/shadow_atlas.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/shadow_casters.h"
#include "render/shadow_moments.h"
#include "render/shadow_reach.h"

namespace lamp::app {

struct ShadowSettings {
  ShadowFilter filter = ShadowFilter::pcf;
  PointShadows points = PointShadows::faces;
  std::uint32_t atlas_size = 4096;           ///< texels
  std::uint32_t lights = ~0U;                ///< so many of the first have shadows, at most
  std::uint64_t budget_texels = ALL_TEXELS;  ///< drawn in a frame
  float texels_per_pixel = 1.0F;             ///< of maps over those of the picture (ShadowAtlasInfo)
};

/// What shading binds for its look-up (lib/shaders/shadow), and the constant that says which filter.
inline constexpr std::uint32_t BINDING_SHADOW_MAPS = 11;
inline constexpr std::uint32_t BINDING_SHADOW_ATLAS = 12;
inline constexpr std::uint32_t BINDING_SHADOW_MOMENTS = 13;
inline constexpr std::uint32_t CONSTANT_SHADOW_FILTER = 15;
using ShadowBound = std::array<vulkan::Bound, 3>;

[[nodiscard]] vulkan::Constant shadow_constant(std::optional<ShadowFilter> filter);
/// Adds bindings and constant to those of a pipeline that shades. Without a filter everything is lit.
void add_shadows(vulkan::PipelineInfo& pipeline, std::optional<ShadowFilter> filter);

/// In place of shadows where there are none: something to bind.
class NoShadows {
 public:
  explicit NoShadows(const vulkan::Device& device);
  [[nodiscard]] ShadowBound bound() const;

 private:
  GpuImage atlas_;
  vulkan::Buffer maps_;
};

class Shadows {
 public:
  /// Throws Error for an atlas that the device cannot have, and for a device that cannot draw it.
  Shadows(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowSettings& settings,
          std::uint32_t light_capacity);

  /// What has moved before the next `schedule`: spheres around where it was and is.
  void move(std::span<const shared::LightSphere> moved) { moved_.insert(moved_.end(), moved.begin(), moved.end()); }
  /// Of the next frame.
  void schedule(std::span<const View> views, std::span<const shared::Light> lights);
  /// Draws and uploads what the last `schedule` asked for; nothing if that is done.
  void record(vulkan::Recorder& recorder);

  [[nodiscard]] const ShadowSettings& settings() const { return settings_; }
  [[nodiscard]] const ShadowCounts& counts() const { return counts_; }
  [[nodiscard]] std::span<const std::uint32_t> waiting() const { return waiting_; }  ///< lights, as counted
  [[nodiscard]] std::span<const std::uint32_t> without() const { return without_; }
  [[nodiscard]] std::span<const shared::ShadowMap> maps() const { return maps_; }
  /// Of each light that has a map, in how many frames it was not drawn.
  [[nodiscard]] std::span<const std::uint32_t> ages() const { return ages_; }
  [[nodiscard]] const GpuImage& atlas() const { return atlas_; }
  /// Of vsm and evsm; else null.
  [[nodiscard]] const ShadowMoments* moments() const { return moments_ ? &*moments_ : nullptr; }
  [[nodiscard]] ShadowBound bound() const;
  /// How far each light reaches before something stops it.
  [[nodiscard]] const vulkan::Buffer& radial_bounds() const { return radial_.buffer(); }

  /// Meshes around what each light lights take memory and time, so they are made from the first call on.
  void need_meshes();
  /// Nothing where they are up to date, or not needed.
  void record_meshes(vulkan::Recorder& recorder);
  /// shared::LightMesh of each light; null until they are needed.
  [[nodiscard]] const vulkan::Buffer* meshes() const { return meshes_ ? &meshes_->buffer() : nullptr; }

 private:
  void make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders);
  void record_uploads(vulkan::Recorder& recorder);
  void record_clears(vulkan::Recorder& recorder) const;
  void record_batch(vulkan::Recorder& recorder, std::uint32_t first_view, std::uint32_t count);
  void record_draws(vulkan::Recorder& recorder) const;
  void begin_atlas(VkCommandBuffer commands) const;

  ShadowSettings settings_;
  const vulkan::Device& device_;
  const ShaderLibrary& shaders_;
  const GpuScene& scene_;
  std::uint32_t light_capacity_;
  ShadowCasters casters_;
  std::uint32_t views_a_batch_ = 1;
  ShadowAtlas schedule_;
  GpuImage atlas_;
  bool cleared_ = false;  ///< all of the image, once
  vulkan::Buffer caster_buffer_;
  vulkan::Buffer draw_template_;
  vulkan::Buffer draws_;
  vulkan::Buffer pairs_;
  vulkan::Buffer views_;
  vulkan::Buffer map_buffer_;
  vulkan::Buffer staging_;  ///< maps, then views
  vulkan::Pipeline cull_;
  vulkan::Pipeline opaque_;
  vulkan::Pipeline masked_;

  std::optional<ShadowMoments> moments_;
  ShadowReach radial_;
  std::optional<ShadowReach> meshes_;
  bool changed_ = false;  ///< since the last `record`
  ShadowCounts counts_;
  std::vector<std::uint32_t> waiting_;
  std::vector<std::uint32_t> without_;
  std::vector<shared::ShadowMap> maps_;
  std::vector<std::uint32_t> ages_;
  std::vector<shared::Light> lights_;       ///< of the last `schedule`
  std::vector<shared::LightSphere> moved_;  ///< since then
  std::vector<VkClearRect> clears_;
  std::uint32_t view_count_ = 0;
};

}  // namespace lamp::app
