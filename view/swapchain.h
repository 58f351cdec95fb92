// The images of a window's surface, drawn one at a time.
// Promise: never waits for a picture; `ready` says whether the last one is done.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/context.h"
#include "view/gui.h"

namespace lamp::app {

class Swapchain {
 public:
  /// Takes the surface over. Throws Error where the device cannot present to it.
  Swapchain(Context& context, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  [[nodiscard]] VkFormat format() const { return format_; }
  /// Makes images of this size, of which there may be none yet.
  void resize(const Gui& gui, glm::uvec2 size);
  [[nodiscard]] glm::uvec2 size() const { return size_; }
  [[nodiscard]] bool ready() const;
  /// Records into the next image, submits, presents. False: the surface is another than it was, `resize` first.
  [[nodiscard]] bool draw(const std::function<void(VkCommandBuffer, const Canvas&)>& record);
  /// Until nothing of it is under way.
  void wait();

 private:
  struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkSemaphore drawn = VK_NULL_HANDLE;
  };
  void choose_format();
  void make_images(const Gui& gui);
  void destroy_images();
  void submit(const Image& image);

  Context& context_;
  VkDevice device_;
  VkSurfaceKHR surface_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkColorSpaceKHR color_space_ = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  VkSwapchainKHR chain_ = VK_NULL_HANDLE;
  glm::uvec2 size_{0};
  std::vector<Image> images_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkSemaphore acquired_ = VK_NULL_HANDLE;
  VkFence done_ = VK_NULL_HANDLE;  ///< of the last submission
};

}  // namespace lamp::app
