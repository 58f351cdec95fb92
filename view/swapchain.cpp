// One command buffer, one fence: the interface is small, and the next is drawn when the last is done.
// SPDX-License-Identifier: Apache-2.0
#include "view/swapchain.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <mutex>

#include "gpu/check.h"

namespace lamp::app {
namespace {

VkSemaphore make_semaphore(VkDevice device) {
  const VkSemaphoreCreateInfo create{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &create, nullptr, &semaphore), "window: a semaphore");
  return semaphore;
}

/// The surface is another than it was: the images must be made anew.
bool is_outdated(VkResult result) { return result == VK_ERROR_OUT_OF_DATE_KHR; }
/// There is an image to draw into, even if the surface would take another kind faster.
bool is_drawable(VkResult result) { return result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR; }

}  // namespace

Swapchain::Swapchain(Context& context, VkSurfaceKHR surface)
    : context_(context), device_(context.device().handle), surface_(surface) {
  VkBool32 presents = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(context.device().physical, context.queue_family(), surface, &presents),
        "asking whether the device presents");
  if (presents == VK_FALSE)
    throw Error(fmt::format("device {}: cannot present to this display; expected another --device, or --headless",
                            context.row().name),
                Exit::no_device);
  choose_format();
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                     .queueFamilyIndex = context.queue_family()};
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "window: a command pool");
  const VkCommandBufferAllocateInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool_,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device_, &commands, &commands_), "window: a command buffer");
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .flags = VK_FENCE_CREATE_SIGNALED_BIT};
  check(vkCreateFence(device_, &fence, nullptr, &done_), "window: a fence");
  acquired_ = make_semaphore(device_);
}

void Swapchain::choose_format() {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceSurfaceFormatsKHR(context_.device().physical, surface_, &count, nullptr);
  std::vector<VkSurfaceFormatKHR> formats(count);
  vkGetPhysicalDeviceSurfaceFormatsKHR(context_.device().physical, surface_, &count, formats.data());
  // The picture is encoded already; a format that encodes once more would be too bright.
  for (const VkSurfaceFormatKHR& format : formats)
    if (format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM) {
      format_ = format.format;
      color_space_ = format.colorSpace;
      return;
    }
  throw Error("the window's surface has no format of eight bits a channel without encoding, expected one",
              Exit::no_device);
}

Swapchain::~Swapchain() {
  wait();
  destroy_images();
  vkDestroySwapchainKHR(device_, chain_, nullptr);
  vkDestroySemaphore(device_, acquired_, nullptr);
  vkDestroyFence(device_, done_, nullptr);
  vkDestroyCommandPool(device_, pool_, nullptr);
  vkDestroySurfaceKHR(context_.instance().handle, surface_, nullptr);
}

void Swapchain::destroy_images() {
  for (const Image& image : images_) {
    vkDestroySemaphore(device_, image.drawn, nullptr);
    vkDestroyFramebuffer(device_, image.framebuffer, nullptr);
    vkDestroyImageView(device_, image.view, nullptr);
  }
  images_.clear();
}

void Swapchain::wait() {
  const std::lock_guard lock(context_.queue_mutex());
  vkQueueWaitIdle(context_.queue());
}

void Swapchain::resize(const Gui& gui, glm::uvec2 size) {
  wait();
  destroy_images();
  VkSurfaceCapabilitiesKHR can{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context_.device().physical, surface_, &can), "the window's surface");
  const bool is_fixed = can.currentExtent.width != ~0U;
  size_ = is_fixed ? glm::uvec2(can.currentExtent.width, can.currentExtent.height)
                   : glm::clamp(size, glm::uvec2(can.minImageExtent.width, can.minImageExtent.height),
                                glm::uvec2(can.maxImageExtent.width, can.maxImageExtent.height));
  const VkSwapchainKHR old = std::exchange(chain_, VK_NULL_HANDLE);
  VkResult made = VK_SUCCESS;
  if (size_.x != 0 && size_.y != 0) {
    const std::uint32_t most = can.maxImageCount == 0 ? ~0U : can.maxImageCount;
    const VkSwapchainCreateInfoKHR create{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = surface_,
        .minImageCount = std::min(can.minImageCount + 1, most),
        .imageFormat = format_,
        .imageColorSpace = color_space_,
        .imageExtent = {size_.x, size_.y},
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .preTransform = can.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_TRUE,
        .oldSwapchain = old};
    made = vkCreateSwapchainKHR(device_, &create, nullptr, &chain_);
  }
  vkDestroySwapchainKHR(device_, old, nullptr);
  check(made, "the window's images");
  if (chain_ != VK_NULL_HANDLE) make_images(gui);
}

void Swapchain::make_images(const Gui& gui) {
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_, chain_, &count, nullptr), "the window's images");
  std::vector<VkImage> images(count);
  check(vkGetSwapchainImagesKHR(device_, chain_, &count, images.data()), "the window's images");
  for (VkImage image : images) {
    Image& made = images_.emplace_back();
    made.image = image;
    const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = format_,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    check(vkCreateImageView(device_, &view, nullptr, &made.view), "the window's images");
    const VkFramebufferCreateInfo framebuffer{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                              .renderPass = gui.render_pass(),
                                              .attachmentCount = 1,
                                              .pAttachments = &made.view,
                                              .width = size_.x,
                                              .height = size_.y,
                                              .layers = 1};
    check(vkCreateFramebuffer(device_, &framebuffer, nullptr, &made.framebuffer), "the window's images");
    made.drawn = make_semaphore(device_);
  }
}

bool Swapchain::ready() const { return vkGetFenceStatus(device_, done_) == VK_SUCCESS; }

bool Swapchain::draw(const std::function<void(VkCommandBuffer, const Canvas&)>& record) {
  if (chain_ == VK_NULL_HANDLE) return false;
  check(vkWaitForFences(device_, 1, &done_, VK_TRUE, UINT64_MAX), "waiting for the window's last image");
  std::uint32_t index = 0;
  const VkResult next = vkAcquireNextImageKHR(device_, chain_, UINT64_MAX, acquired_, VK_NULL_HANDLE, &index);
  if (is_outdated(next)) return false;
  if (!is_drawable(next)) check(next, "taking the window's next image");
  const Image& image = images_[index];
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands_, &begin), "drawing the window");
  record(commands_, {.image = image.image, .framebuffer = image.framebuffer, .size = size_});
  check(vkEndCommandBuffer(commands_), "drawing the window");
  const std::lock_guard lock(context_.queue_mutex());
  submit(image);
  const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                 .waitSemaphoreCount = 1,
                                 .pWaitSemaphores = &image.drawn,
                                 .swapchainCount = 1,
                                 .pSwapchains = &chain_,
                                 .pImageIndices = &index};
  const VkResult shown = vkQueuePresentKHR(context_.queue(), &present);
  if (!is_drawable(shown) && !is_outdated(shown)) check(shown, "showing the window's image");
  return shown == VK_SUCCESS;
}

void Swapchain::submit(const Image& image) {
  check(vkResetFences(device_, 1, &done_), "drawing the window");
  const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                         .commandBuffer = commands_};
  const VkSemaphoreSubmitInfo wait_for{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                       .semaphore = acquired_,
                                       .stageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT};
  const VkSemaphoreSubmitInfo signal{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                     .semaphore = image.drawn,
                                     .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
  const VkSubmitInfo2 work{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .waitSemaphoreInfoCount = 1,
                           .pWaitSemaphoreInfos = &wait_for,
                           .commandBufferInfoCount = 1,
                           .pCommandBufferInfos = &buffer,
                           .signalSemaphoreInfoCount = 1,
                           .pSignalSemaphoreInfos = &signal};
  check(vkQueueSubmit2(context_.queue(), 1, &work, done_), "drawing the window");
}

}  // namespace lamp::app
