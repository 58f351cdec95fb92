// What shadow maps say of how far a scene's lights reach: radial bounds (lamplight/shared/radial.h) or meshes
// (lamplight/shared/light_mesh.h). Made anew for lights whose maps or places changed, kept of all others.
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

  /// Of the next `record`: lights that were redrawn, and those of another map or place than the last time.
  void set(std::span<const shared::ShadowMap> maps, std::span<const shared::Light> lights,
           std::span<const ShadowRedraw> redraws);
  /// `maps`: the buffer of all maps; `atlas`: depths.
  void record(vulkan::Recorder& recorder, const vulkan::Resource& maps, const GpuImage& atlas);

  /// shared::RadialBound, or shared::LightMesh, of each light.
  [[nodiscard]] const vulkan::Buffer& buffer() const { return buffer_; }

 private:
  void record_nothing_known(vulkan::Recorder& recorder);

  const char* name_;
  vulkan::Buffer buffer_;
  vulkan::Buffer jobs_;
  vulkan::Pipeline pipeline_;
  std::vector<shared::ShadowMap> maps_;  ///< as they were made from
  std::vector<std::uint8_t> shows_all_;
  std::vector<std::uint8_t> pending_;  ///< to be made by the next `record`
  std::uint32_t job_count_ = 0;
  bool begun_ = false;
};

}  // namespace lamp::app
