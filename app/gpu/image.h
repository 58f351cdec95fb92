// A GPU image with its memory and view, and the ways it is used.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lamplight/vulkan.h"

namespace lamp::app {

struct GpuImageInfo {
  std::string name;
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint32_t mips = 1;
  std::uint32_t layers = 1;  ///< of which the last one is used
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
  VkImageUsageFlags usage = 0;
  VkImageCreateFlags flags = 0;
};

class GpuImage {
 public:
  GpuImage() = default;
  /// Throws Error that names the image.
  GpuImage(const vulkan::Device& device, const GpuImageInfo& info);

  [[nodiscard]] const GpuImageInfo& info() const { return info_; }
  [[nodiscard]] VkImage handle() const { return image_.get(); }
  [[nodiscard]] VkImageView view() const { return view_.get(); }
  /// What its view shows: of formats with stencil the depth alone.
  [[nodiscard]] VkImageAspectFlags aspect() const;
  [[nodiscard]] bool has_stencil() const;
  /// Its first level, to or from the beginning of a buffer, row by row.
  [[nodiscard]] VkBufferImageCopy whole() const;

  /// As a descriptor or an attachment, with the layout that goes with it.
  [[nodiscard]] vulkan::Resource sampled() const;
  [[nodiscard]] vulkan::Resource combined(VkSampler sampler) const;
  [[nodiscard]] vulkan::Resource storage() const;
  [[nodiscard]] vulkan::Resource attachment() const;
  [[nodiscard]] vulkan::Resource transfer_source() const;
  [[nodiscard]] vulkan::Resource transfer_target() const;

 private:
  [[nodiscard]] vulkan::Resource as(VkDescriptorType type, VkImageLayout layout) const;

  GpuImageInfo info_;
  vulkan::OwnedMemory memory_;
  vulkan::OwnedImage image_;
  vulkan::OwnedImageView view_;
};

/// Levels of a full mip chain.
[[nodiscard]] std::uint32_t full_mip_count(std::uint32_t width, std::uint32_t height);

}  // namespace lamp::app
