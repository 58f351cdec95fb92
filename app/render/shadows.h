// Shadow maps of a scene's lights: the atlas's image, what is drawn into it each frame, and what shading reads.
// Promise: the library's atlas decides which squares are drawn, the GPU finds which casters each of them shows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lamplight/entity.h"
#include "lamplight/shadow_atlas.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/shadow_drawing.h"
#include "render/shadow_moments.h"
#include "render/shadow_reach.h"

namespace lamp::app {

/// What draws maps. automatic: compute, but on a device that ends loops the hardware's rasterizer.
enum class ShadowRaster : std::uint8_t { automatic, hardware, compute };

/// Throws Error for a device on which it might lose triangles of large squares.
void check_shadow_raster(const Context& context, ShadowRaster raster);

struct ShadowSettings {
  ShadowFilter filter = ShadowFilter::pcf;
  PointShadows points = PointShadows::faces;
  ShadowRaster raster = ShadowRaster::automatic;
  ShadowBlur blur = ShadowBlur::fused;       ///< of vsm and evsm
  std::uint32_t raster_items = 1U << 22;     ///< in compute: room for blocks of large triangles, 8 bytes each
  std::uint32_t atlas_size = 4096;           ///< texels
  std::uint32_t lights = ~0U;                ///< so many of the first have shadows, at most
  std::uint64_t budget_texels = ALL_TEXELS;  ///< drawn in a frame
  float texels_per_pixel = 1.0F;             ///< of maps over those of the picture (ShadowAtlasInfo)
};

/// What shading binds for its look-up (lib/shaders/shadow), and the constant that says which filter.
inline constexpr std::uint32_t BINDING_SHADOW_MAPS = SHADOW_BINDING;
inline constexpr std::uint32_t BINDING_SHADOW_ATLAS = SHADOW_BINDING + 1;
inline constexpr std::uint32_t BINDING_SHADOW_MOMENTS = SHADOW_BINDING + 2;
inline constexpr std::uint32_t CONSTANT_SHADOW_FILTER = SHADOW_CONSTANT;
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
  /// At most `box_capacity` boxes have their numbers between those of lights. Throws Error for an atlas that the device
  /// cannot have, and for a device that cannot draw it.
  Shadows(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowSettings& settings,
          std::uint32_t light_capacity, std::uint32_t box_capacity = 0);

  /// What has moved before the next `schedule`: spheres around where it was and is.
  void move(std::span<const shared::LightSphere> moved) { moved_.insert(moved_.end(), moved.begin(), moved.end()); }
  /// Forgets all frames: the next is as the first. Sizes and places of squares follow from those before, too.
  void restart();
  /// Of the next frame: lights, and boxes that may be between them.
  void schedule(std::span<const View> views, std::span<const shared::Light> records, EntityRange boxes = {});
  /// Draws and uploads what the last `schedule` asked for; nothing if that is done.
  void record(vulkan::Recorder& recorder);

  /// What the next `record` and `record_reach` draw and make of the last `schedule`. Given back after them it is drawn
  /// and made once more, with the same result: what frames that are not timed must leave to the one that is.
  struct Pending {
    bool maps = false;
    std::array<std::vector<shared::RadialJob>, 2> jobs;  ///< by ShadowReach::Kind
  };
  [[nodiscard]] Pending pending() const;
  void set_pending(const Pending& pending);

  [[nodiscard]] const ShadowSettings& settings() const { return settings_; }
  [[nodiscard]] const ShadowCounts& counts() const { return counts_; }
  [[nodiscard]] std::span<const std::uint32_t> waiting() const { return waiting_; }  ///< records, as counted
  [[nodiscard]] std::span<const std::uint32_t> without() const { return without_; }
  /// The number of a record's light, boxes left out.
  [[nodiscard]] std::uint32_t light_of(std::uint32_t record) const {
    return record < boxes_.first ? record : record - boxes_.count();
  }
  /// Of each record.
  [[nodiscard]] std::span<const shared::ShadowMap> maps() const { return maps_; }
  /// Of each record that has a map, in how many frames it was not drawn.
  [[nodiscard]] std::span<const std::uint32_t> ages() const { return ages_; }
  [[nodiscard]] const GpuImage& atlas() const { return drawing_->atlas(); }
  /// Of vsm and evsm; else null.
  [[nodiscard]] const ShadowMoments* moments() const { return moments_ ? &*moments_ : nullptr; }
  [[nodiscard]] ShadowBound bound() const;

  /// Bounds of what lights light take memory and time, so each kind is made from the first call on. With
  /// ShadowBlur::listing they cut nothing: its taps lie anywhere.
  void need(ShadowReach::Kind kind);
  /// Draws the maps, too, if they are not up to date.
  void record_reach(vulkan::Recorder& recorder);
  /// shared::RadialBound or shared::LightMesh of each light; null until they are needed.
  [[nodiscard]] const vulkan::Buffer* reach(ShadowReach::Kind kind) const;

 private:
  void record_uploads(vulkan::Recorder& recorder);
  /// How many records the scheduler knows, at most: of lights that cast, and boxes.
  [[nodiscard]] std::uint32_t casting_capacity() const;
  [[nodiscard]] bool bounds_lights() const { return settings_.blur != ShadowBlur::listing || !moments_; }

  ShadowSettings settings_;
  const vulkan::Device& device_;
  const ShaderLibrary& shaders_;
  std::uint32_t light_capacity_;
  std::uint32_t box_capacity_;
  ShadowAtlas schedule_;
  std::unique_ptr<ShadowDrawing> drawing_;
  vulkan::Buffer views_;
  vulkan::Buffer map_buffer_;
  vulkan::Buffer staging_;  ///< maps, then views

  std::optional<ShadowMoments> moments_;
  std::array<std::optional<ShadowReach>, 2> reaches_;  ///< by kind
  bool changed_ = false;                               ///< since the last `record`
  ShadowCounts counts_;
  EntityRange boxes_;  ///< among the records of the last `schedule`
  std::vector<std::uint32_t> waiting_;
  std::vector<std::uint32_t> without_;
  std::vector<shared::ShadowMap> maps_;
  std::vector<std::uint32_t> ages_;
  std::vector<shared::Light> records_;      ///< of the last `schedule`; boxes have no range
  std::vector<shared::LightSphere> moved_;  ///< since then
  std::vector<ShadowSquare> redrawn_squares_;
  std::vector<shared::ShadowView> host_views_;
  std::vector<ShadowSquare> viewports_;  ///< of the views
};

}  // namespace lamp::app
