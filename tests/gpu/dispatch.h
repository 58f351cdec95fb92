// One dispatch of a test shader, waited for, and the resources it takes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"

namespace lamp::app {

/// A storage buffer that the host can write and read, zeroed.
[[nodiscard]] vulkan::Buffer host_buffer(const std::string& name, std::uint64_t bytes);

template <class T>
[[nodiscard]] vulkan::Buffer host_buffer_of(const std::string& name, const std::vector<T>& values) {
  vulkan::Buffer buffer = host_buffer(name, values.size() * sizeof(T));
  std::memcpy(buffer.mapped().data(), values.data(), values.size() * sizeof(T));
  return buffer;
}

template <class T>
[[nodiscard]] std::vector<T> contents(const vulkan::Buffer& buffer) {
  std::vector<T> values(buffer.bytes() / sizeof(T));
  std::memcpy(values.data(), buffer.mapped().data(), values.size() * sizeof(T));
  return values;
}

struct DepthImageKind {
  VkFormat format = VK_FORMAT_D32_SFLOAT;  ///< of 32-bit floats
  std::uint32_t layers = 1;                ///< the last one is it
};

/// A depth image with these device depths, row by row, ready to be sampled.
[[nodiscard]] GpuImage depth_image(std::uint32_t width, std::uint32_t height, const std::vector<float>& depth,
                                   const DepthImageKind& kind = {});

/// An image of four floats a texel, ready to be sampled.
[[nodiscard]] GpuImage float_image(std::uint32_t width, std::uint32_t height, const std::vector<glm::vec4>& texels);

/// A test shader with specialization constants 0, 1, 2, ... and bindings 0, 1, 2, ...
struct Dispatch {
  std::string_view shader;
  std::vector<std::uint32_t> constants;
  std::vector<vulkan::Resource> resources;
  glm::uvec3 groups{1, 1, 1};
};
void dispatch(const Dispatch& what);

}  // namespace lamp::app
