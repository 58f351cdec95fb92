// Formats and usages of the targets.
// SPDX-License-Identifier: Apache-2.0
#include "render/targets.h"

namespace lamp::app {
namespace {

// Copied from and to by captures.
constexpr VkImageUsageFlags GBUFFER = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

}  // namespace

Targets::Targets(const vulkan::Device& device, std::uint32_t wide, std::uint32_t high) : width(wide), height(high) {
  const auto make = [&](const char* name, VkFormat format, VkImageUsageFlags usage) {
    return GpuImage(device, {.name = name, .width = wide, .height = high, .format = format, .usage = usage});
  };
  depth = make("depth", VK_FORMAT_D32_SFLOAT,
               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                   VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  base_color = make("base colour", VK_FORMAT_R8G8B8A8_SRGB, GBUFFER);
  surface = make("surface", VK_FORMAT_R32G32_UINT, GBUFFER);
  emission = make("emission", VK_FORMAT_R16G16B16A16_SFLOAT, GBUFFER);
  hdr = make("hdr", VK_FORMAT_R32G32B32A32_SFLOAT,
             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
}

void Targets::need_triangles(const vulkan::Device& device) {
  if (triangles.handle() != VK_NULL_HANDLE) return;
  triangles = GpuImage(
      device, {.name = "triangles", .width = width, .height = height, .format = VK_FORMAT_R32_UINT, .usage = GBUFFER});
}

std::vector<vulkan::Bound> gbuffer_bound(const Targets& targets) {
  return {{1, targets.depth.sampled()},
          {5, targets.base_color.sampled()},
          {6, targets.surface.sampled()},
          {7, targets.emission.sampled()}};
}

vulkan::Bound triangles_bound(const Targets& targets) {
  return {BINDING_TRIANGLES, (targets.numbered ? targets.triangles : targets.surface).sampled()};
}

}  // namespace lamp::app
