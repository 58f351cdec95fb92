// Descriptor sets, for devices where descriptors cannot be pushed: an arena, whose sets are taken back all at once.
// Promise: pools are kept, so frames that bind as much as those before allocate nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/vulkan/device.h"
#include "lamplight/vulkan/owned.h"
#include "lamplight/vulkan/pipeline.h"

namespace lamp::vulkan {

/// Destroy it before the device, and after the commands that use its sets are done.
class LAMPLIGHT_API DescriptorSets {
 public:
  DescriptorSets() = default;
  // Written out: MSVC would make the copies for a DLL, which `pools_` does not let it.
  DescriptorSets(DescriptorSets&&) noexcept = default;
  DescriptorSets& operator=(DescriptorSets&&) noexcept = default;
  DescriptorSets(const DescriptorSets&) = delete;
  DescriptorSets& operator=(const DescriptorSets&) = delete;
  ~DescriptorSets() = default;
  explicit DescriptorSets(const Device& device) : device_(device.handle), vk_(device.vk) {}

  /// A set of a pipeline's layout, whose bindings nobody has written. Errors: no memory left.
  [[nodiscard]] Result<VkDescriptorSet> allocate(const Pipeline& pipeline);

  /// Takes all sets back. No commands under way may use one.
  void reset();

  /// The first error of `allocate` since the last reset. Commands that were recorded then must not be submitted.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  [[nodiscard]] std::optional<Error> add_pool(const Pipeline& pipeline);

  VkDevice device_ = VK_NULL_HANDLE;
  DeviceFunctions vk_;
  std::vector<OwnedDescriptorPool> pools_;
  std::size_t current_ = 0;  ///< those before it are full
  std::optional<Error> error_;
};

}  // namespace lamp::vulkan
