// The cull of a frame as a host with a Culler records it, for its times.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "lamplight/vulkan.h"
#include "render/lighting_pipelines.h"

namespace lamp::app {

struct LightingFrame;

class CullerPass {
 public:
  /// All that the Culler records, as one pass of the times.
  static constexpr std::string_view NAME = "culler";

  /// Throws Error when the method does not fit the device.
  CullerPass(const vulkan::Device& device, const LightingInfo& info);

  void record(vulkan::Recorder& recorder, const LightingFrame& frame);
  /// Says that all that was recorded has run.
  void finish();
  [[nodiscard]] vulkan::BoundLookUp lookup() const { return culler_.lookup(); }
  [[nodiscard]] shared::Counters counters() const { return culler_.counters(); }

 private:
  vulkan::Culler culler_;
  bool host_barriers_ = false;
  std::uint64_t recorded_ = 0;  ///< frame that was not finished yet, or 0
};

}  // namespace lamp::app
