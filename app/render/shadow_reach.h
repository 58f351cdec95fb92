// What shadow maps say of how far a scene's lights reach: radial bounds (lamplight/shared/radial.h) or meshes
// (lamplight/shared/light_mesh.h). Made anew for lights whose maps or places changed, kept of all others.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gpu/context.h"
#include "lamplight/shadow_atlas.h"
#include "lamplight/shared/radial.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"

namespace lamp::app {

class ShadowReach {
 public:
  enum class Kind : std::uint8_t { radial, meshes };

  /// At first nothing is known of any light.
  ShadowReach(const vulkan::Device& device, const ShaderLibrary& shaders, Kind kind, ShadowFilter filter,
              std::uint32_t light_capacity, std::uint32_t atlas_size);

  /// For the next `record`, with those that are still to be done.
  void add(std::span<const shared::RadialJob> jobs);
  /// `maps`: the buffer of all maps; `atlas`: depths.
  void record(vulkan::Recorder& recorder, const vulkan::Resource& maps, const GpuImage& atlas);

  /// What the next `record` makes.
  [[nodiscard]] std::vector<shared::RadialJob> pending() const;

  /// shared::RadialBound, or shared::LightMesh, of each light.
  [[nodiscard]] const vulkan::Buffer& buffer() const { return buffer_; }

 private:
  void record_nothing_known(vulkan::Recorder& recorder);

  const char* name_;
  vulkan::Buffer buffer_;
  vulkan::Buffer jobs_;
  vulkan::Pipeline pipeline_;
  std::vector<std::optional<shared::RadialJob>> pending_;  ///< by light
  bool begun_ = false;
};

}  // namespace lamp::app
