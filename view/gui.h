// Dear ImGui on the tool's device: its input, its font, its draws over a picture.
// Promise: one at a time, as ImGui has one context.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

#include "gpu/context.h"
#include "gpu/image.h"
#include "lamplight/vulkan.h"
#include "view/input.h"

namespace lamp::app {

/// A rectangle of the screen, pixels.
struct ScreenRect {
  glm::ivec2 min{0};
  glm::ivec2 max{0};

  [[nodiscard]] glm::ivec2 size() const { return max - min; }
  [[nodiscard]] bool empty() const { return max.x <= min.x || max.y <= min.y; }
  friend bool operator==(const ScreenRect&, const ScreenRect&) = default;
};

/// What is drawn into.
struct Canvas {
  VkImage image = VK_NULL_HANDLE;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;  ///< of Gui::render_pass()
  glm::uvec2 size{0};
};

class Gui {
 public:
  /// `end`: the layout in which a canvas is left.
  Gui(Context& context, VkFormat format, VkImageLayout end, float scale);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  [[nodiscard]] VkRenderPass render_pass() const { return render_pass_; }

  /// Begins the interface of a frame; `seconds` since the last.
  void begin(const Input& input, glm::uvec2 size, float seconds);
  /// Ends it.
  void end();
  /// Records the picture, stretched into the rectangle, and the interface over it.
  /// What was recorded before is done.
  void record(VkCommandBuffer commands, const Canvas& canvas, const GpuImage* picture, const ScreenRect& where);
  /// How long the device took to draw the interface, without the picture below, that was recorded last but one; nothing
  /// before that, and where the device tells no times.
  [[nodiscard]] std::optional<double> interface_ms() const { return interface_ms_; }

 private:
  void make_render_pass(VkFormat format, VkImageLayout end);
  void make_backend();

  Context& context_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkRenderPass render_pass_ = VK_NULL_HANDLE;
  vulkan::Timestamps timestamps_;
  bool recorded_ = false;
  std::optional<double> interface_ms_;
};

/// The keyboard moves the focus among widgets; a field takes what is typed; a widget is being used.
[[nodiscard]] bool interface_has_focus();
[[nodiscard]] bool interface_takes_text();
[[nodiscard]] bool interface_is_used();

/// The clipboard: the desktop's in a window.
[[nodiscard]] std::string clipboard();
void set_clipboard(const std::string& text);

}  // namespace lamp::app
