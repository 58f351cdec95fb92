// What changes every frame: the camera's record and the lights, on the GPU.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lamplight/view.h"
#include "lamplight/vulkan.h"

namespace lamp::app {

class FrameData {
 public:
  FrameData(const vulkan::Device& device, std::uint32_t light_capacity);

  /// Host side; the copies are recorded by `record_upload`.
  void set(const View& view, std::span<const shared::Light> lights);
  void record_upload(vulkan::Recorder& recorder) const;

  [[nodiscard]] vulkan::Resource frame() const { return vulkan::Resource::storage(frame_.handle()); }
  [[nodiscard]] vulkan::Resource lights() const { return vulkan::Resource::storage(lights_.handle()); }
  [[nodiscard]] std::uint32_t light_count() const { return host_frame_.light_count; }
  [[nodiscard]] vulkan::PlanInputs plan_inputs(const vulkan::Resource& depth) const;

 private:
  vulkan::Buffer frame_;
  vulkan::Buffer lights_;
  vulkan::Buffer staging_;  ///< shared::Frame, then the lights
  shared::Frame host_frame_{};
  std::vector<shared::Light> host_lights_;
};

}  // namespace lamp::app
