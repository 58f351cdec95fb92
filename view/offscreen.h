// A screen without a window: what is drawn is read back.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "image/image.h"
#include "view/gui.h"

namespace lamp::app {

class Offscreen {
 public:
  static constexpr VkFormat FORMAT = VK_FORMAT_R8G8B8A8_UNORM;
  static constexpr VkImageLayout END = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;

  Offscreen(Context& context, const Gui& gui, glm::uvec2 size);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  [[nodiscard]] glm::uvec2 size() const { return {image_.info().width, image_.info().height}; }
  /// Draws the picture and the interface, and waits.
  void draw(Gui& gui, const GpuImage* picture, const ScreenRect& where);
  /// What was drawn last.
  [[nodiscard]] LdrImage read();

 private:
  Context& context_;
  GpuImage image_;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

}  // namespace lamp::app
