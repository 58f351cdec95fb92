// Bytes between the host and the GPU, waited for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/image.h"

namespace lamp::app {

/// A device buffer with these bytes in it (at least 16, so that an empty span gives a buffer too).
[[nodiscard]] vulkan::Buffer upload_buffer(Context& context, const std::string& name, std::span<const std::byte> bytes,
                                           VkBufferUsageFlags usage);

/// An eight-bit image with a full mip chain, made by repeated halving with a linear filter.
[[nodiscard]] GpuImage upload_texture(Context& context, const GpuImageInfo& info, std::span<const std::byte> rgba);

template <class T>
[[nodiscard]] std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

}  // namespace lamp::app
