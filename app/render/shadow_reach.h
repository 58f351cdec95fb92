// What shadow maps say of how far a scene's lights reach: radial bounds (lamplight/shared/radial.h) or meshes
// (lamplight/shared/light_mesh.h). Made anew for lights whose maps or places changed, kept of all others.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gpu/context.h"
#include "lamplight/shadow_atlas.h"
#include "lamplight/shared/radial.h"
#include "lamplight/shared/shadow.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"

namespace lamp::app {

struct ShadowReachInput {
  vulkan::Resource maps;                         ///< the buffer of all maps
  std::span<const shared::ShadowMap> host_maps;  ///< the same
  const GpuImage& atlas;                         ///< depths
};

class ShadowReach {
 public:
  enum class Kind : std::uint8_t { radial, meshes };

  /// At first nothing is known of any light.
  ShadowReach(const vulkan::Device& device, const ShaderLibrary& shaders, Kind kind, ShadowFilter filter,
              std::uint32_t light_capacity);

  /// For the next `record`, with those that are still to be done.
  void add(std::span<const shared::RadialJob> jobs);
  void record(vulkan::Recorder& recorder, const ShadowReachInput& input);

  /// What the next `record` makes.
  [[nodiscard]] std::vector<shared::RadialJob> pending() const;

  /// shared::RadialBound, or shared::LightMesh, of each light.
  [[nodiscard]] const vulkan::Buffer& buffer() const { return buffer_; }

 private:
  void record_nothing_known(vulkan::Recorder& recorder);

  Kind kind_;
  vulkan::Buffer buffer_;
  vulkan::Buffer jobs_;
  std::vector<vulkan::Pipeline> pipelines_;                ///< for many lights, for few; of meshes one
  vulkan::Pipeline clear_;                                 ///< before several groups make a bound; meshes have none
  std::vector<std::optional<shared::RadialJob>> pending_;  ///< by light
  bool begun_ = false;
};

}  // namespace lamp::app
