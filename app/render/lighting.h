// Lights a picture: one method, one shading path. Culls, shades, adds transparent surfaces.
// Promise: every path works over every look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "lamplight/method.h"
#include "render/decal_pass.h"
#include "render/geometry.h"

namespace lamp::app {

enum class ShadingPath : std::uint8_t {
  forward,            ///< Forward+: fragments walk their cell
  tiled_deferred,     ///< one fused dispatch where the method has one and there are no decals, else as `deferred`
  deferred,           ///< cull, then shade in compute
  standard_deferred,  ///< no cull: one volume a light, added up by blending
};
enum class Brdf : std::uint32_t { ggx = 0, blinn_phong = 1 };

/// "forward", "tiled-deferred", "deferred", "standard-deferred", in the order of ShadingPath.
[[nodiscard]] std::span<const std::string_view> path_names();

/// Rows of a picture; 0 rows: all of it.
struct Rows {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

struct LightingInfo {
  const Method* method = nullptr;
  Options options;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t light_capacity = 0;  ///< decals included
  ShadingPath path = ShadingPath::deferred;
  Brdf brdf = Brdf::ggx;
  bool transparency = false;  ///< the scene has blended surfaces
  bool captured = false;      ///< the scene is a captured frame
  bool decals = false;        ///< the frames have decals
  /// Of the options, those that room was made with, for what did not fit with the ones asked for.
  std::vector<std::pair<std::string, std::string>> grown;
  /// What is shaded: a reference picture may need a part alone. `first` is a multiple of 8; not with a fused look-up.
  Rows shaded;
};

/// What a frame is lit with.
struct LightingFrame {
  const GpuScene& scene;
  const FrameData& data;
  const Targets& targets;
  const Geometry& geometry;
  const CapturedSurfaces* kept = nullptr;  ///< fills the G-buffer instead of drawing, if there
  glm::vec3 eye{0.0F};
  bool surfaces_drawn = false;  ///< the targets hold them: deferred paths without decals draw none
};

class Lighting {
 public:
  /// Throws Error when the plan does not fit the device.
  Lighting(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info);

  /// Geometry, cull, shade; leaves the picture in targets.hdr and the depth in targets.depth.
  void record(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Geometry, and the decals on it: what a deferred path lights.
  void record_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Only the cull, over the depth that is there.
  void record_cull(vulkan::Recorder& recorder, const LightingFrame& frame);

  [[nodiscard]] const LightingInfo& info() const { return info_; }
  [[nodiscard]] vulkan::PlanRunner& runner() { return runner_; }
  [[nodiscard]] const vulkan::PlanRunner& runner() const { return runner_; }
  [[nodiscard]] bool fused() const;
  /// The options that `vulkan::Culler` would grow to after a frame that needed so much (of the plan's capacities).
  /// Nothing if everything fitted, or nothing can grow.
  [[nodiscard]] std::optional<Options> grown(std::span<const std::uint32_t> needed) const;
  /// Of them, those that change, and their values.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> fits_with(std::span<const std::uint32_t> needed) const;
  /// What the driver says of the pipeline of a pass of this name (of the times); empty where it says nothing.
  [[nodiscard]] std::span<const vulkan::PipelineStatistic> statistics(std::string_view pass) const;
  /// Whether a pass of this name (of the times) belongs to the cull.
  [[nodiscard]] bool is_cull_pass(std::string_view name) const;

 private:
  using Passes = vulkan::PlanRunner::Passes;
  void build_shade(const vulkan::Device& device, const ShaderLibrary& shaders);
  void build_transparent(const vulkan::Device& device, const ShaderLibrary& shaders);
  void shade_forward(vulkan::Recorder& recorder, const LightingFrame& frame);
  void shade_captured(vulkan::Recorder& recorder, const LightingFrame& frame);
  void shade_compute(vulkan::Recorder& recorder, const LightingFrame& frame);
  void add_volumes(vulkan::Recorder& recorder, const LightingFrame& frame);
  void add_transparent(vulkan::Recorder& recorder, const LightingFrame& frame);

  LightingInfo info_;
  DeviceTraits traits_;
  vulkan::PlanRunner runner_;
  std::optional<vulkan::PlanRunner> any_depth_runner_;  ///< for transparent surfaces, if the method needs another
  vulkan::Pipeline shade_;
  vulkan::Pipeline volumes_;
  vulkan::Pipeline transparent_;
  std::optional<DecalPass> decals_;  ///< of the deferred paths
};

/// The options of a method whose values are others than before, and the values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> changed_options(const Options& before,
                                                                               const Options& after);

/// A method's plan for these traits, or its error thrown.
[[nodiscard]] Plan plan_or_throw(const LightingInfo& info, const vulkan::Device& device);

}  // namespace lamp::app
