// An image, its framebuffer, and the way back.
// SPDX-License-Identifier: Apache-2.0
#include "view/offscreen.h"

#include <cstring>
#include <glm/glm.hpp>

#include "gpu/check.h"

namespace lamp::app {

Offscreen::Offscreen(Context& context, const Gui& gui, glm::uvec2 size)
    : context_(context),
      image_(context.device(), {.name = "screen",
                                .width = size.x,
                                .height = size.y,
                                .format = FORMAT,
                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_DST_BIT}) {
  const VkImageView view = image_.view();
  const VkFramebufferCreateInfo create{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = gui.render_pass(),
                                       .attachmentCount = 1,
                                       .pAttachments = &view,
                                       .width = size.x,
                                       .height = size.y,
                                       .layers = 1};
  check(vkCreateFramebuffer(context.device().handle, &create, nullptr, &framebuffer_), "screen");
}

Offscreen::~Offscreen() { vkDestroyFramebuffer(context_.device().handle, framebuffer_, nullptr); }

void Offscreen::draw(Gui& gui, const GpuImage* picture, const ScreenRect& where) {
  context_.submit([&](VkCommandBuffer commands) {
    gui.record(commands, {.image = image_.handle(), .framebuffer = framebuffer_, .size = size()}, picture, where);
  });
}

LdrImage Offscreen::read() {
  LdrImage read{.width = size().x, .height = size().y, .pixels = {}};
  read.pixels.resize(std::size_t{read.width} * read.height);
  const vulkan::Buffer buffer =
      take(vulkan::Buffer::create(context_.device(), {.name = "screen read-back",
                                                      .bytes = read.pixels.size() * sizeof(glm::u8vec4),
                                                      .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                      .memory = vulkan::MemoryUse::readback}));
  context_.submit([&](VkCommandBuffer commands) {
    const VkBufferImageCopy whole = image_.whole();
    vkCmdCopyImageToBuffer(commands, image_.handle(), END, buffer.handle(), 1, &whole);
    const VkBufferMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                         .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                         .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                         .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                         .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT,
                                         .buffer = buffer.handle(),
                                         .size = VK_WHOLE_SIZE};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .bufferMemoryBarrierCount = 1, .pBufferMemoryBarriers = &to_host};
    vkCmdPipelineBarrier2(commands, &dependency);
  });
  std::memcpy(read.pixels.data(), buffer.mapped().data(), read.pixels.size() * sizeof(glm::u8vec4));
  for (glm::u8vec4& pixel : read.pixels) pixel.a = 255;
  return read;
}

}  // namespace lamp::app
