// Where buffers get their memory: a host's allocator, or an allocation of their own each.
// Based on: Vulkan Memory Allocator, whose vmaAllocateMemoryForBuffer fits `MemoryCallbacks::allocate`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace lamp::vulkan {

enum class MemoryUse : std::uint8_t {
  device,    ///< GPU only
  upload,    ///< host writes, GPU reads; mapped
  readback,  ///< GPU writes, host reads; mapped
  counts,    ///< GPU adds up, host reads few bytes; mapped, and the device's own memory where such can be mapped
  records,   ///< host writes few bytes, GPU reads them; likewise
};

/// A part of a device's memory, which Lamplight binds a buffer to.
struct Allocation {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< bytes
  void* mapped = nullptr;   ///< all but device: the first byte at `offset`, coherent, until it is released
  void* host = nullptr;     ///< whatever the host wants to know it by
};

/// Both set, or neither: then each buffer has a vkAllocateMemory of its own. Called by whoever makes, grows or destroys
/// a Culler or a PlanRunner, on that thread.
struct MemoryCallbacks {
  void* user = nullptr;  ///< handed back
  /// With Device::buffer_addresses, memory for buffers on the GPU alone is allocated with
  /// VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT. Another result than VK_SUCCESS becomes the error of whoever wanted the
  /// buffer, and `out` is not looked at.
  VkResult (*allocate)(void* user, VkBuffer buffer, const VkMemoryRequirements& needs, MemoryUse use,
                       Allocation& out) = nullptr;
  void (*release)(void* user, const Allocation& allocation) = nullptr;  ///< after its buffer was destroyed
};

}  // namespace lamp::vulkan
