// Mirrored light: a ray for each pixel of a surface smooth enough, its hit found in compute, and lit with lights looked
// up by position. docs/methods/mirror.md. Promise: whatever finds a hit's lights, the picture is the same: to the bit
// where lists ascend. What is not known (a search that the device ended) is counted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/gpu_scene.h"
#include "render/lighting_pipelines.h"
#include "render/mirror_scene.h"

namespace lamp::app {

struct LightingFrame;

/// What hits look lights up in.
enum class MirrorLists : std::uint8_t { world_cells, ikkala_grid, brute_force };
/// "world-cells", "ikkala-grid", "brute-force", in the order of MirrorLists.
[[nodiscard]] std::span<const std::string_view> mirror_list_names();

struct MirrorSettings {
  float roughness = 0.0F;  ///< from which on surfaces mirror nothing, 0 .. 1; they fade towards it from its half on
  MirrorLists lists = MirrorLists::world_cells;
  Brdf brdf = Brdf::ggx;
  bool walks_apart = false;  ///< lists are walked once more, by a pass that does nothing else: for its time
};

struct MirrorInfo {
  MirrorSettings settings;
  std::uint32_t width = 0;  ///< of the pictures
  std::uint32_t height = 0;
  std::uint32_t light_capacity = 0;  ///< decals included
  std::optional<ShadowFilter> shadows;
};

class MirrorPass {
 public:
  /// Throws Error for pictures whose hits do not fit a buffer of the device, and what a plan does not fit. The scene
  /// must live on.
  MirrorPass(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const MirrorInfo& info);

  /// Adds to the opaque surfaces in `targets.hdr`, whose G-buffer there is.
  void record(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Makes what the frame counted visible to the host, for `counts`.
  void record_counts(vulkan::Recorder& recorder);
  [[nodiscard]] gpu::MirrorCounts counts() const;
  /// Of the lists: cells that did not fit.
  [[nodiscard]] std::uint32_t overflowed_cells() const;
  /// All that was recorded has run.
  void finish();
  /// Instances of the scene have moved.
  void move(Context& context);

  [[nodiscard]] const MirrorInfo& info() const { return info_; }
  [[nodiscard]] const MirrorScene& scene() const { return scene_; }
  [[nodiscard]] const vulkan::Buffer& hits() const { return hits_; }          ///< gpu::MirrorHit of each pixel
  [[nodiscard]] const vulkan::Buffer& surfaces() const { return surfaces_; }  ///< gpu::MirrorSurface, where it hits
  [[nodiscard]] std::vector<std::pair<std::string, std::uint64_t>> bytes() const;

 private:
  [[nodiscard]] vulkan::PlanInputs inputs(const LightingFrame& frame) const;
  void dispatch(vulkan::Recorder& recorder, const char* name, const vulkan::Pipeline& pipeline,
                const std::vector<vulkan::Bound>& bound, const std::vector<vulkan::Use>& uses) const;
  void trace(vulkan::Recorder& recorder, const LightingFrame& frame);
  void find_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame);
  void shade(vulkan::Recorder& recorder, const LightingFrame& frame, bool walks_alone);

  const Scene& of_;
  MirrorInfo info_;
  MirrorScene scene_;
  vulkan::PlanRunner runner_;
  vulkan::Buffer hits_;
  vulkan::Buffer surfaces_;
  vulkan::Buffer walked_;  ///< lights at each pixel's hit, where they are walked apart
  vulkan::Buffer counts_;
  vulkan::Buffer read_counts_;
  vulkan::Pipeline trace_;
  vulkan::Pipeline find_surfaces_;
  vulkan::Pipeline shade_;
  vulkan::Pipeline walk_;  ///< apart
};

/// Its own pipelines, of a stack for a scene's hierarchy (Bvh::stack).
struct MirrorPipelines {
  vulkan::Pipeline trace;
  vulkan::Pipeline surfaces;
  vulkan::Pipeline shade;
  vulkan::Pipeline walk;  ///< of look-ups alone
};
[[nodiscard]] MirrorPipelines mirror_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders,
                                               const MirrorInfo& info, const Plan& plan, std::uint32_t stack);
/// Of the lists.
[[nodiscard]] Plan mirror_plan(const vulkan::Device& device, const MirrorInfo& info);

}  // namespace lamp::app
