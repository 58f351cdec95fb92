// Lights a picture: one method, one shading path. Culls, shades, adds transparent surfaces.
// Promise: every path works over every look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "render/culler_pass.h"
#include "render/decal_pass.h"
#include "render/geometry.h"
#include "render/lighting_pipelines.h"
#include "render/shadows.h"

namespace lamp::app {

class MirrorPass;

/// What a frame is lit with.
struct LightingFrame {
  const GpuScene& scene;
  const FrameData& data;
  const Targets& targets;
  const Geometry& geometry;
  vulkan::PlanInputs inputs;               ///< what is culled: `data` and `targets.depth`, or more views and samples
  std::uint32_t view = 0;                  ///< which of them `data` is
  const CapturedSurfaces* kept = nullptr;  ///< fills the G-buffer instead of drawing, if there
  std::span<const View> views;             ///< all that are culled
  glm::vec3 eye{0.0F};
  ShadowBound shadows{};              ///< what look-ups of shadows bind
  vulkan::Resource still{};           ///< and those of lights that stand still
  MirrorPass* mirror = nullptr;       ///< adds mirrored light, if there
  std::vector<vulkan::Bound> probes;  ///< and those of probes
  bool surfaces_drawn = false;        ///< the targets hold them: deferred paths without decals draw none
  /// The method's lists are those of an earlier picture, with the same lights seen from the same eye: of methods that
  /// look up by position, which know no other direction.
  bool culled = false;
};

class Lighting {
 public:
  /// Throws Error when the plan does not fit the device.
  Lighting(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info);

  /// Geometry, cull, shade; leaves the picture in targets.hdr and the depth in targets.depth.
  void record(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Geometry, and the decals on it: what a deferred path lights.
  void record_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Only the cull, over the depth that is there: of the method's lists.
  void record_cull(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Says that all that was recorded has run: what is kept need not be made again.
  void finish();
  /// Only the cull of the lists that transparent surfaces have of their own, where these have some.
  void record_any_depth_cull(vulkan::Recorder& recorder, const LightingFrame& frame);

  [[nodiscard]] const LightingInfo& info() const { return info_; }
  [[nodiscard]] vulkan::PlanRunner& runner() { return runner_; }
  [[nodiscard]] const vulkan::PlanRunner& runner() const { return runner_; }
  /// Whose lists transparent surfaces have for themselves, since the method's hold at one depth alone; null: none.
  [[nodiscard]] const Method* any_depth_method() const { return any_depth_ ? any_depth_->method : nullptr; }
  [[nodiscard]] const Options& any_depth_options() const { return any_depth_->problem.options; }
  [[nodiscard]] const Plan& any_depth_plan() const { return any_depth_->runner.plan(); }
  [[nodiscard]] bool fused() const;
  /// Makes what the frame counted visible to the host, for `counts`.
  void record_counts(vulkan::Recorder& recorder);
  [[nodiscard]] vulkan::FrameCounts counts() const;
  /// Of the lists that transparent surfaces have of their own, likewise.
  [[nodiscard]] vulkan::FrameCounts any_depth_counts() const;
  /// The options that `vulkan::Culler` would grow to after a frame that needed so much (of the plan's capacities).
  /// Nothing if everything fitted, or nothing can grow.
  [[nodiscard]] std::optional<Options> grown(std::span<const std::uint32_t> needed) const;
  /// The same of the lists that transparent surfaces have of their own.
  [[nodiscard]] std::optional<Options> any_depth_grown(std::span<const std::uint32_t> needed) const;
  /// Of the method's, those that change, and their values.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> fits_with(std::span<const std::uint32_t> needed) const;
  /// What the driver says of the pipeline of a pass of this name (of the times); empty where it says nothing.
  [[nodiscard]] std::span<const vulkan::PipelineStatistic> statistics(std::string_view pass) const;
  /// Whether a pass of this name (of the times) belongs to the cull.
  [[nodiscard]] bool is_cull_pass(std::string_view name) const;

 private:
  using Passes = vulkan::PlanRunner::Passes;
  [[nodiscard]] vulkan::BoundLookUp lookup(const LightingFrame& frame) const;
  /// Whether opaque surfaces are shaded with a look-up, which a separate cull fills.
  [[nodiscard]] bool walks() const;
  void shade_forward(vulkan::Recorder& recorder, const LightingFrame& frame);
  void shade_captured(vulkan::Recorder& recorder, const LightingFrame& frame);
  void shade_compute(vulkan::Recorder& recorder, const LightingFrame& frame);
  void add_volumes(vulkan::Recorder& recorder, const LightingFrame& frame);
  void add_transparent(vulkan::Recorder& recorder, const LightingFrame& frame);

  LightingInfo info_;
  DeviceTraits traits_;
  vulkan::PlanRunner runner_;
  std::optional<CullerPass> culler_;  ///< records instead, for such a host
  struct AnyDepth {
    const Method* method = nullptr;
    Problem problem;
    vulkan::PlanRunner runner;
  };
  std::optional<AnyDepth> any_depth_;  ///< for transparent surfaces, if the method's plan does not hold for them
  vulkan::Pipeline shade_;
  vulkan::Pipeline volumes_;
  vulkan::Pipeline transparent_;
  std::optional<DecalPass> decals_;  ///< of the deferred paths
};

/// The options of a method whose values are others than before, and the values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> changed_options(const Options& before,
                                                                               const Options& after);

}  // namespace lamp::app
