// What changes every frame, on the GPU: the camera's record, the lights, and the decals behind them (entity.h).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lamplight/entity.h"
#include "lamplight/view.h"
#include "lamplight/vulkan.h"
#include "render/shaders/decal_data.h"

namespace lamp::app {

class FrameData {
 public:
  FrameData(const vulkan::Device& device, std::uint32_t light_capacity, std::uint32_t decal_capacity = 0);

  /// Host side; the copies are recorded by the next `record_upload`.
  void set(const View& view, std::span<const shared::Light> lights, std::span<const gpu::DecalData> decals = {});
  /// The same lights and decals, seen otherwise.
  void set_view(const View& view);
  /// Nothing if it was recorded before, and nothing has been set since.
  void record_upload(vulkan::Recorder& recorder);

  [[nodiscard]] vulkan::Resource frame() const { return vulkan::Resource::storage(frame_.handle()); }
  /// The same as a uniform buffer: no instruction loads it on some GPUs.
  [[nodiscard]] vulkan::Resource frame_constants() const {
    return {.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, .buffer = frame_.handle()};
  }
  [[nodiscard]] vulkan::Resource lights() const { return vulkan::Resource::storage(lights_.handle()); }
  [[nodiscard]] vulkan::Resource spheres() const { return vulkan::Resource::storage(spheres_.handle()); }
  [[nodiscard]] vulkan::Resource decals() const { return vulkan::Resource::storage(decals_.handle()); }
  /// The ids of lights and decals.
  [[nodiscard]] EntityRanges entities() const {
    return entity_ranges(host_frame_.light_count - host_frame_.box_count, host_frame_.box_count);
  }
  [[nodiscard]] vulkan::PlanInputs plan_inputs(const vulkan::Resource& depth) const;

 private:
  vulkan::Buffer frame_;
  vulkan::Buffer lights_;   ///< and a record for each decal
  vulkan::Buffer spheres_;  ///< of all these
  vulkan::Buffer decals_;
  vulkan::Buffer staging_;  ///< shared::Frame, then the lights with the decals' records, their spheres, the decals
  bool changed_ = true;     ///< since the last upload
  shared::Frame host_frame_{};
  std::vector<shared::Light> host_lights_;  ///< with the decals' records
};

}  // namespace lamp::app
