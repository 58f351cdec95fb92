// Depth images of several samples a pixel, each sample drawn as a picture of its own; and where samples lie.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/image.h"
#include "render/shader_library.h"

namespace lamp::app {

/// Where Vulkan's standard places of 1, 2, 4 or 8 samples lie in a pixel, 0 .. 1 from its top left corner. Source:
/// Vulkan specification, "Multisampling", standard sample locations.
[[nodiscard]] std::span<const glm::dvec2> sample_places(std::uint32_t samples);

struct SampledDepthInfo {
  std::uint32_t samples = 1;
  std::uint32_t width = 1;   ///< of the image, pixels
  std::uint32_t height = 1;  ///< likewise
  VkFormat format = VK_FORMAT_D32_SFLOAT;
  VkOffset2D offset{};  ///< where the picture begins
  float beyond = 0.0F;  ///< depth around the picture
};

/// The image, and what draws pictures into its samples.
class SampledDepth {
 public:
  /// Throws Error where the device has no such image.
  SampledDepth(const vulkan::Device& device, const ShaderLibrary& shaders, const SampledDepthInfo& info);

  /// Draws a picture into a sample; sample 0 clears the others. Take each in turn.
  void record(vulkan::Recorder& recorder, const GpuImage& picture, std::uint32_t sample) const;
  [[nodiscard]] const GpuImage& image() const { return image_; }

 private:
  SampledDepthInfo info_;
  GpuImage image_;
  std::vector<vulkan::Pipeline> pipelines_;  ///< one a sample
};

/// Throws Error where the device draws or reads no depth images of so many samples.
void check_depth_samples(const vulkan::Device& device, std::uint32_t samples);

}  // namespace lamp::app
