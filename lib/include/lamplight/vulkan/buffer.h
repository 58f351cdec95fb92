// A buffer and its memory.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "lamplight/export.h"
#include "lamplight/vulkan/device.h"
#include "lamplight/vulkan/owned.h"

namespace lamp::vulkan {

/// A part of somebody's buffer, as descriptors show it; a handle alone is the whole.
struct BufferPart {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;             ///< bytes, where the part begins
  VkDeviceSize bytes = VK_WHOLE_SIZE;  ///< that it has, or all that follow; at most maxStorageBufferRange

  BufferPart() = default;
  BufferPart(VkBuffer of, VkDeviceSize from = 0, VkDeviceSize length = VK_WHOLE_SIZE)
      : buffer(of), offset(from), bytes(length) {}
};

struct BufferInfo {
  std::string name;
  std::uint64_t bytes = 0;  ///< > 0
  VkBufferUsageFlags usage = 0;
  MemoryUse memory = MemoryUse::device;
};

class LAMPLIGHT_API Buffer {
 public:
  Buffer() = default;
  /// Errors name the buffer and its size.
  [[nodiscard]] static Result<Buffer> create(const Device& device, const BufferInfo& info);

  [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// Host-visible buffers: their bytes, coherent; others: empty.
  [[nodiscard]] std::span<std::byte> mapped() const { return {mapped_, mapped_ == nullptr ? 0 : bytes_}; }

 private:
  [[nodiscard]] Result<Allocation> allocate(const Device& device, const BufferInfo& info);

  // One of them; both outlive the buffer.
  OwnedMemory memory_;
  std::shared_ptr<const Allocation> host_memory_;
  OwnedBuffer buffer_;
  std::uint64_t bytes_ = 0;
  std::byte* mapped_ = nullptr;
};

}  // namespace lamp::vulkan
