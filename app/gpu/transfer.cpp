// Uploads through a staging buffer.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/transfer.h"

#include <algorithm>
#include <cstring>

#include "gpu/check.h"

namespace lamp::app {
namespace {

vulkan::Buffer staging(Context& context, std::span<const std::byte> bytes) {
  vulkan::Buffer buffer =
      take(vulkan::Buffer::create(context.device(), {.name = "staging",
                                                     .bytes = std::max<std::uint64_t>(bytes.size(), 16),
                                                     .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                     .memory = vulkan::MemoryUse::upload}));
  if (!bytes.empty()) std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());
  return buffer;
}

void level_barrier(VkCommandBuffer commands, VkImage image, std::uint32_t level, VkImageLayout from, VkImageLayout to) {
  const bool begins = from == VK_IMAGE_LAYOUT_UNDEFINED;
  const VkImageMemoryBarrier2 barrier{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = begins ? VK_PIPELINE_STAGE_2_NONE : VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
      .srcAccessMask = begins ? VK_ACCESS_2_NONE : VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_TRANSFER_READ_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
      .dstAccessMask =
          VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, level, 1, 0, 1}};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

VkOffset3D corner(const GpuImageInfo& info, std::uint32_t level) {
  return {static_cast<std::int32_t>(std::max(1U, info.width >> level)),
          static_cast<std::int32_t>(std::max(1U, info.height >> level)), 1};
}

void halve(VkCommandBuffer commands, const GpuImage& image, std::uint32_t level) {
  const VkImageBlit blit{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1},
                         .srcOffsets = {{}, corner(image.info(), level - 1)},
                         .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1},
                         .dstOffsets = {{}, corner(image.info(), level)}};
  vkCmdBlitImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.handle(),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
}

}  // namespace

vulkan::Buffer readback_buffer(const vulkan::Device& device, const std::string& name, std::uint64_t bytes) {
  return take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = std::max<std::uint64_t>(bytes, 16),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                      .memory = vulkan::MemoryUse::readback}));
}

vulkan::Buffer upload_buffer(Context& context, const std::string& name, std::span<const std::byte> bytes,
                             VkBufferUsageFlags usage) {
  vulkan::Buffer buffer =
      take(vulkan::Buffer::create(context.device(), {.name = name,
                                                     .bytes = std::max<std::uint64_t>(bytes.size(), 16),
                                                     .usage = usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT}));
  const vulkan::Buffer source = staging(context, bytes);
  context.submit([&](VkCommandBuffer commands) {
    const VkBufferCopy whole{.size = buffer.bytes()};
    vkCmdCopyBuffer(commands, source.handle(), buffer.handle(), 1, &whole);
  });
  return buffer;
}

GpuImage upload_texture(Context& context, const GpuImageInfo& wanted, std::span<const std::byte> rgba) {
  GpuImageInfo info = wanted;
  info.mips = full_mip_count(info.width, info.height);
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  GpuImage image(context.device(), info);
  const vulkan::Buffer source = staging(context, rgba);
  context.submit([&](VkCommandBuffer commands) {
    for (std::uint32_t level = 0; level < info.mips; ++level)
      level_barrier(commands, image.handle(), level, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy whole = image.whole();
    vkCmdCopyBufferToImage(commands, source.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
    for (std::uint32_t level = 1; level < info.mips; ++level) {
      level_barrier(commands, image.handle(), level - 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
      halve(commands, image, level);
    }
    for (std::uint32_t level = 0; level < info.mips; ++level)
      level_barrier(
          commands, image.handle(), level,
          level + 1 == info.mips ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  return image;
}

}  // namespace lamp::app
