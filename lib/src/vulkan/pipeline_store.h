// What two pipelines must have in common to be one: everything but the name, as bytes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/vulkan/pipeline.h"

namespace lamp::vulkan {

class Description {
 public:
  /// Set layouts differ where descriptors are pushed.
  explicit Description(const Device& device) { add(device.pushes_descriptors() ? 1 : 0); }
  Description& operator<<(const PipelineInfo& info);
  Description& operator<<(std::span<const std::uint32_t> spirv);
  Description& operator<<(const GraphicsState& state);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void add(std::uint64_t value);
  std::string bytes_;
};

}  // namespace lamp::vulkan
