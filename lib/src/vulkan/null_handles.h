// Handles that are null, and tables that nobody filled: said before Vulkan is called with them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "lamplight/vulkan/device.h"

namespace lamp::vulkan {

/// What is not `load_instance`'s.
[[nodiscard]] inline std::optional<Error> check_loaded(const Instance& instance) {
  if (instance.handle != VK_NULL_HANDLE && instance.vk.vkGetDeviceProcAddr != nullptr) return std::nullopt;
  return Error{"instance", "expected one that load_instance gave, got null"};
}

[[nodiscard]] inline std::optional<Error> check_handle(VkDevice device) {
  if (device != VK_NULL_HANDLE) return std::nullopt;
  return Error{"device", "expected a VkDevice, got null"};
}

/// What is not `make_device`'s.
[[nodiscard]] inline std::optional<Error> check_made(const Device& device) {
  if (device.handle == VK_NULL_HANDLE || device.vk.vkCreateBuffer == nullptr)
    return Error{"device", "expected one that make_device gave, got null"};
  if ((device.memory_callbacks.allocate == nullptr) != (device.memory_callbacks.release == nullptr))
    return Error{"memory callbacks", "expected both allocate and release, or neither"};
  return std::nullopt;
}

}  // namespace lamp::vulkan
