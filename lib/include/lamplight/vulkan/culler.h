// One object for engines that want no plans: depth, camera and lights in, a look-up out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lamplight/method.h"
#include "lamplight/shared/counters.h"
#include "lamplight/view.h"
#include "lamplight/vulkan/plan_runner.h"

namespace lamp::vulkan {

struct CullerInfo {
  std::uint32_t width = 0;   ///< pixels
  std::uint32_t height = 0;  ///< pixels
  std::uint32_t light_capacity = 0;
  std::string method = "clustered";  ///< `lamp list methods`
  std::vector<std::string> options;  ///< "tile=32"
};

/// What a frame brings. Lights and depth must be visible to compute shaders when the recorded commands run.
struct CullerFrame {
  const View* view = nullptr;                  ///< its size must be the Culler's
  VkBuffer lights = VK_NULL_HANDLE;            ///< storage buffer of shared::Light (`lamp::pack`)
  std::uint32_t light_count = 0;               ///< at most the capacity
  std::span<const shared::Light> host_lights;  ///< only for options that work on the CPU: the same lights
  VkImage depth_image = VK_NULL_HANDLE;        ///< only for methods that need depth: one sample, device depth
  VkImageView depth_view = VK_NULL_HANDLE;     ///< of its depth aspect
  VkImageLayout depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
};

/// Owns the buffers and pipelines of one method at one size. One frame in flight: a second `record` may run on the GPU
/// only after the first (as on one queue it does).
class Culler {
 public:
  Culler() = default;
  /// Errors: an unknown method or option (with the nearest names), a size or capacity beyond the device's limits, no
  /// memory left.
  [[nodiscard]] static Result<Culler> create(const Device& device, const CullerInfo& info);

  /// Records the passes. What they wrote is visible to compute and fragment shaders recorded later.
  void record(VkCommandBuffer commands, const CullerFrame& frame);

  /// How a shader reads the result: the file lookup/NAME.glsl, constants for its specialization, resources for its
  /// descriptors (set 0, bindings from LOOKUP_BINDING). Holds until the Culler is destroyed.
  [[nodiscard]] BoundLookUp lookup() const;

  /// What the last finished frame counted: cells that did not fit and were walked as all lights.
  /// Read it after that frame's fence.
  [[nodiscard]] shared::Counters counters() const;

  /// Bytes on the GPU.
  [[nodiscard]] std::uint64_t bytes() const { return runner_.plan().bytes(); }

 private:
  Device device_;
  Buffer frame_;
  Buffer counters_;
  PlanRunner runner_;
  AccessTracker tracker_;
};

}  // namespace lamp::vulkan
