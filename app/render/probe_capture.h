// Draws what reflection probes see: six pictures of a scene around a position, lit like any other, into an atlas.
// Promise: a method that looks up by position is culled once for all six; the picture is that of brute force, bit for
// bit where lists ascend. A capture sees no probes, and depends on no capture before it: all shadow maps are its own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/lighting.h"
#include "render/probe_atlas.h"
#include "render/probe_set.h"
#include "render/still_lists.h"

namespace lamp::app {

struct ProbeCaptureInfo {
  const Method* method = nullptr;  ///< null: world-cells
  Options options;                 ///< of this method; not looked at without one
  std::uint32_t light_capacity = 0;
  std::uint32_t decal_capacity = 0;
  Brdf brdf = Brdf::ggx;
  std::optional<ShadowSettings>
      shadows;  ///< lights cast them, into maps of each capture's own; the budget is the picture's
};

/// Views of the faces of a cube around a position, in the order of gpu::PROBE_FACES (common/probe_map.glsl).
[[nodiscard]] std::vector<View> probe_views(const glm::vec3& position);

class ProbeCapture {
 public:
  /// `scene` has meshes: a captured frame is seen from one place alone. Throws Error for what the device cannot do.
  ProbeCapture(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ProbeCaptureInfo& info);

  /// Of the next captures; they must live on. No more than the capacities.
  void set(std::span<const shared::Light> lights, std::span<const gpu::DecalData> decals = {});

  /// Draws the faces, and fills the slot's block. Waits for it.
  void capture(const glm::vec3& position, const ProbeAtlas& atlas, std::uint32_t slot);

  /// Of the last capture; null: no light casts any.
  [[nodiscard]] const Shadows* shadows() const { return shadows_ ? &*shadows_ : nullptr; }

  /// How often lights were culled since the beginning.
  [[nodiscard]] std::uint32_t culls() const { return culls_; }

 private:
  void draw_face(std::uint32_t face, std::span<const View> views, const ProbeAtlas& atlas);
  void record_face(vulkan::Recorder& recorder, std::uint32_t face, const ProbeAtlas& atlas);
  [[nodiscard]] LightingFrame frame(const View& view, bool culled) const;

  Context& context_;
  const GpuScene& scene_;
  Targets targets_;
  FrameData data_;
  Geometry geometry_;
  NoShadows no_shadows_;
  std::unique_ptr<ProbeAtlas> no_captures_;  ///< stays where it is: the set refers to it
  ProbeSet no_probes_;
  StillLists no_still_;
  std::optional<Shadows> shadows_;
  Lighting lighting_;
  vulkan::Pipeline face_;
  vulkan::AccessTracker tracker_;
  std::vector<vulkan::Resource> depths_;
  std::span<const shared::Light> lights_;
  std::span<const gpu::DecalData> decals_;
  std::uint32_t culls_ = 0;
};

}  // namespace lamp::app
