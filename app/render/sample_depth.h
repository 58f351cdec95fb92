// Depth images of several samples a pixel, made of one image for each sample; and where samples lie.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "gpu/context.h"
#include "gpu/image.h"
#include "lamplight/view.h"
#include "render/shader_library.h"

namespace lamp::app {

/// Where Vulkan's standard places of 1, 2, 4 or 8 samples lie in a pixel, 0 .. 1 from its top left corner. Source:
/// Vulkan specification, "Multisampling", standard sample locations.
[[nodiscard]] std::span<const glm::dvec2> sample_places(std::uint32_t samples);

/// The view whose pixels' centres are where `view` has the places `at` of its pixels.
[[nodiscard]] View view_through(const View& view, glm::dvec2 at);

struct SampledDepthInfo {
  std::uint32_t width = 1;   ///< of the image, pixels
  std::uint32_t height = 1;  ///< likewise
  VkFormat format = VK_FORMAT_D32_SFLOAT;
  VkOffset2D offset{};  ///< where the picture begins
  float beyond = 0.0F;  ///< depth around the picture
};

/// Draws the images, each into its sample. They must be in the layout of `GpuImage::sampled`, and so is the result, for
/// compute shaders. Throws Error where the device has no such image.
[[nodiscard]] GpuImage sampled_depth(Context& context, const ShaderLibrary& shaders,
                                     std::span<const GpuImage* const> of_samples, const SampledDepthInfo& info);

}  // namespace lamp::app
