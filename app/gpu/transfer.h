// Bytes between the host and the GPU, waited for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/image.h"

namespace lamp::app {

/// A device buffer with these bytes in it (at least 16, so that an empty span gives a buffer too).
[[nodiscard]] vulkan::Buffer upload_buffer(Context& context, const std::string& name, std::span<const std::byte> bytes,
                                           VkBufferUsageFlags usage);

/// A mapped buffer that shaders and copies write, and the host reads (at least 16 bytes, likewise).
[[nodiscard]] vulkan::Buffer readback_buffer(const vulkan::Device& device, const std::string& name,
                                             std::uint64_t bytes);

/// The first values of a mapped buffer.
template <class T>
[[nodiscard]] std::vector<T> first_values(const vulkan::Buffer& buffer, std::size_t count) {
  std::vector<T> values(count);
  if (count != 0) std::memcpy(values.data(), buffer.mapped().data(), count * sizeof(T));
  return values;
}

/// An eight-bit image with a full mip chain, made by repeated halving with a linear filter.
[[nodiscard]] GpuImage upload_texture(Context& context, const GpuImageInfo& info, std::span<const std::byte> rgba);

template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace lamp::app
