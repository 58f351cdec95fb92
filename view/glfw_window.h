// A window of the desktop: its size, its surface, and what the user does in it, as Input.
// Promise: one at a time. A display that is not there, or goes, is one line and exit code 3.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>
#include <glm/glm.hpp>

#include <span>
#include <string>

#include "view/input.h"

struct GLFWwindow;

namespace lamp::app {

/// GLFW, while it lives.
class Desktop {
 public:
  /// Throws Error (Exit::no_device) where there is no display.
  Desktop();
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// What a Vulkan instance must have enabled for a window's surface.
  [[nodiscard]] std::span<const char* const> instance_extensions() const;
};

class GlfwWindow {
 public:
  GlfwWindow(const std::string& title, glm::uvec2 size);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  [[nodiscard]] VkSurfaceKHR make_surface(VkInstance instance) const;
  /// Takes events, waiting for some at most so long.
  void take_events(double seconds);
  [[nodiscard]] bool wants_to_close() const;
  /// Of what is drawn, pixels; 0 while it is minimised.
  [[nodiscard]] glm::uvec2 size() const;
  void resize(glm::uvec2 size);
  void set_minimised(bool minimised);
  /// What the size that was asked for is multiplied by, as the desktop says.
  [[nodiscard]] float content_scale() const;
  /// How large letters are to be, as the desktop says.
  [[nodiscard]] float scale() const;
  [[nodiscard]] Input& input() { return input_; }
  /// A button that goes down and up between two frames is still seen once.
  void press(std::size_t button, bool down);
  /// The interface's clipboard becomes the desktop's.
  void share_clipboard();

 private:
  void set_callbacks();

  GLFWwindow* window_ = nullptr;
  Input input_;
  std::array<bool, 3> pressed_now_{};    ///< since the last take_events()
  std::array<bool, 3> released_late_{};  ///< and already released
};

/// Ends the waiting of take_events(); from any thread.
void wake_window();

}  // namespace lamp::app
