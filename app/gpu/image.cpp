// Makes images, names them, and says how they are used.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/image.h"

#include <algorithm>
#include <bit>

#include "gpu/check.h"

namespace lamp::app {

std::uint32_t full_mip_count(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

GpuImage::GpuImage(const vulkan::Device& device, const GpuImageInfo& info) : info_(info) {
  const VkImageCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .flags = info.flags,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = info.format,
                                 .extent = {info.width, info.height, 1},
                                 .mipLevels = info.mips,
                                 .arrayLayers = info.layers,
                                 .samples = info.samples,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = info.usage};
  const std::string what = "image " + info.name;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device.handle, &create, nullptr, &image), what.c_str());
  image_ = vulkan::OwnedImage(device.handle, image, vkDestroyImage);
  device.name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image), info.name);

  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.handle, image, &needs);
  const std::uint32_t type =
      take(vulkan::find_memory_type(device, needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
  const VkMemoryAllocateInfo allocate{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.handle, &allocate, nullptr, &memory), what.c_str());
  memory_ = vulkan::OwnedMemory(device.handle, memory, vkFreeMemory);
  check(vkBindImageMemory(device.handle, image, memory, 0), what.c_str());

  const VkImageViewCreateInfo view_create{
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = image,
      .viewType = VK_IMAGE_VIEW_TYPE_2D,
      .format = info.format,
      .subresourceRange = {aspect(), 0, VK_REMAINING_MIP_LEVELS, info.layers - 1, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.handle, &view_create, nullptr, &view), what.c_str());
  view_ = vulkan::OwnedImageView(device.handle, view, vkDestroyImageView);
}

VkImageAspectFlags GpuImage::aspect() const {
  switch (info_.format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    default:
      return has_stencil() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

bool GpuImage::has_stencil() const {
  return info_.format == VK_FORMAT_D16_UNORM_S8_UINT || info_.format == VK_FORMAT_D24_UNORM_S8_UINT ||
         info_.format == VK_FORMAT_D32_SFLOAT_S8_UINT;
}

VkBufferImageCopy GpuImage::whole() const {
  return {.imageSubresource = {aspect(), 0, info_.layers - 1, 1}, .imageExtent = {info_.width, info_.height, 1}};
}

vulkan::Resource GpuImage::as(VkDescriptorType type, VkImageLayout layout) const {
  return {.type = type,
          .image = handle(),
          .view = view(),
          .aspect = has_stencil() ? aspect() | VK_IMAGE_ASPECT_STENCIL_BIT : aspect(),
          .layout = layout};
}

vulkan::Resource GpuImage::sampled() const {
  return as(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, has_stencil() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL
                                              : aspect() == VK_IMAGE_ASPECT_DEPTH_BIT
                                                  ? VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL
                                                  : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

vulkan::Resource GpuImage::combined(VkSampler sampler) const {
  vulkan::Resource resource = sampled();
  resource.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  resource.sampler = sampler;
  return resource;
}

vulkan::Resource GpuImage::storage() const { return as(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_IMAGE_LAYOUT_GENERAL); }

vulkan::Resource GpuImage::attachment() const {
  return as(VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, has_stencil() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                                 : aspect() == VK_IMAGE_ASPECT_DEPTH_BIT
                                                     ? VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL
                                                     : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

vulkan::Resource GpuImage::transfer_source() const {
  return as(VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
}

vulkan::Resource GpuImage::transfer_target() const {
  return as(VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
}

}  // namespace lamp::app
