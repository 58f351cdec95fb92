// GLFW's callbacks fill the Input.
// SPDX-License-Identifier: Apache-2.0
#include "view/glfw_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <imgui.h>
#include <unistd.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include "error.h"
#include "gpu/check.h"

namespace lamp::app {
namespace {

std::string last_error() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words == nullptr ? "no reason given" : words;
}

/// Xlib ends the program when its server goes, after a word of its own; this is ours.
int display_is_gone(void* /*display*/) {
  constexpr std::string_view LINE = "lamp-view: the display is gone, expected it to stay until the window is closed\n";
  static_cast<void>(!write(STDERR_FILENO, LINE.data(), LINE.size()));
  _exit(static_cast<int>(Exit::no_device));
}

/// Where GLFW has loaded Xlib.
void watch_display() {
  using Handler = int (*)(void*);
  using SetHandler = Handler (*)(Handler);
  if (void* symbol = dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"); symbol != nullptr)
    reinterpret_cast<SetHandler>(symbol)(display_is_gone);
}

const std::map<int, std::string>& key_table() {
  static const std::map<int, std::string> TABLE = [] {
    std::map<int, std::string> table{{GLFW_KEY_UP, "up"},
                                     {GLFW_KEY_DOWN, "down"},
                                     {GLFW_KEY_LEFT, "left"},
                                     {GLFW_KEY_RIGHT, "right"},
                                     {GLFW_KEY_TAB, "tab"},
                                     {GLFW_KEY_SPACE, "space"},
                                     {GLFW_KEY_ENTER, "enter"},
                                     {GLFW_KEY_KP_ENTER, "enter"},
                                     {GLFW_KEY_ESCAPE, "escape"},
                                     {GLFW_KEY_BACKSPACE, "backspace"},
                                     {GLFW_KEY_DELETE, "delete"},
                                     {GLFW_KEY_HOME, "home"},
                                     {GLFW_KEY_END, "end"},
                                     {GLFW_KEY_PAGE_UP, "page-up"},
                                     {GLFW_KEY_PAGE_DOWN, "page-down"},
                                     {GLFW_KEY_COMMA, "comma"},
                                     {GLFW_KEY_PERIOD, "period"},
                                     {GLFW_KEY_LEFT_SHIFT, "shift"},
                                     {GLFW_KEY_RIGHT_SHIFT, "shift"},
                                     {GLFW_KEY_LEFT_CONTROL, "ctrl"},
                                     {GLFW_KEY_RIGHT_CONTROL, "ctrl"},
                                     {GLFW_KEY_LEFT_ALT, "alt"},
                                     {GLFW_KEY_RIGHT_ALT, "alt"}};
    for (int i = 0; i < 26; ++i) table[GLFW_KEY_A + i] = std::string(1, static_cast<char>('a' + i));
    for (int i = 0; i < 10; ++i) table[GLFW_KEY_0 + i] = std::string(1, static_cast<char>('0' + i));
    for (int i = 0; i < 12; ++i) table[GLFW_KEY_F1 + i] = fmt::format("f{}", i + 1);
    return table;
  }();
  return TABLE;
}

/// The key's name; letters where the user's keyboard has them.
std::string name_of(int key, int scancode) {
  const char* letter = glfwGetKeyName(key, scancode);
  if (letter != nullptr && letter[0] >= 'a' && letter[0] <= 'z' && letter[1] == '\0') return letter;
  const auto found = key_table().find(key);
  return found == key_table().end() ? "" : found->second;
}

Input& input_of(GLFWwindow* window) { return static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))->input(); }

void on_key(GLFWwindow* window, int key, int scancode, int action, int /*modifiers*/) {
  const std::string name = name_of(key, scancode);
  if (name.empty()) return;
  Input& input = input_of(window);
  if (action == GLFW_RELEASE) {
    if (const auto held = input.held.find(name); held != input.held.end()) input.held.erase(held);
    return;
  }
  input.held.insert(name);
  (action == GLFW_REPEAT ? input.repeated : input.pressed).push_back(name);
}

void on_character(GLFWwindow* window, unsigned int code) {
  std::string& text = input_of(window).text;
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0U | code >> 6U);
    text += static_cast<char>(0x80U | (code & 0x3FU));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0U | code >> 12U);
    text += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
    text += static_cast<char>(0x80U | (code & 0x3FU));
  }  // ImGui was built with 16 bits a character
}

/// From the window's units to pixels.
glm::vec2 pixels_per_unit(GLFWwindow* window) {
  glm::ivec2 units(1);
  glm::ivec2 pixels(1);
  glfwGetWindowSize(window, &units.x, &units.y);
  glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
  return glm::vec2(pixels) / glm::vec2(glm::max(units, glm::ivec2(1)));
}

void on_move(GLFWwindow* window, double x, double y) {
  input_of(window).mouse = glm::vec2(x, y) * pixels_per_unit(window);
}

void on_enter(GLFWwindow* window, int entered) {
  if (entered == GLFW_FALSE) input_of(window).mouse.reset();
}

void on_button(GLFWwindow* window, int button, int action, int /*modifiers*/) {
  if (button < 0 || button >= 3) return;
  static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window))
      ->press(static_cast<std::size_t>(button), action == GLFW_PRESS);
}

void on_scroll(GLFWwindow* window, double x, double y) { input_of(window).wheel += glm::vec2(x, y); }

void on_focus(GLFWwindow* window, int focused) {
  if (focused == GLFW_FALSE) input_of(window).held.clear();  // their release will go elsewhere
}

void on_drop(GLFWwindow* window, int count, const char** files) {
  for (int i = 0; i < count; ++i) input_of(window).dropped.emplace_back(files[i]);
}

}  // namespace

Desktop::Desktop() {
  if (glfwInit() != GLFW_TRUE)
    throw Error(fmt::format("no display: {}; expected one, or --headless with --script", last_error()),
                Exit::no_device);
  watch_display();
  if (glfwVulkanSupported() == GLFW_TRUE) return;
  const std::string words = last_error();
  glfwTerminate();
  throw Error(fmt::format("Vulkan draws into no window here: {}; expected a driver that can", words), Exit::no_device);
}

Desktop::~Desktop() { glfwTerminate(); }

std::span<const char* const> Desktop::instance_extensions() const {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  return {names, count};
}

GlfwWindow::GlfwWindow(const std::string& title, glm::uvec2 size) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);  // as its interface is
  window_ = glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
  if (window_ == nullptr)
    throw Error(fmt::format("the window cannot be opened: {}; expected a display", last_error()), Exit::no_device);
  glfwSetWindowUserPointer(window_, this);
  set_callbacks();
}

GlfwWindow::~GlfwWindow() { glfwDestroyWindow(window_); }

void GlfwWindow::set_callbacks() {
  glfwSetKeyCallback(window_, on_key);
  glfwSetCharCallback(window_, on_character);
  glfwSetCursorPosCallback(window_, on_move);
  glfwSetCursorEnterCallback(window_, on_enter);
  glfwSetMouseButtonCallback(window_, on_button);
  glfwSetScrollCallback(window_, on_scroll);
  glfwSetWindowFocusCallback(window_, on_focus);
  glfwSetDropCallback(window_, on_drop);
}

VkSurfaceKHR GlfwWindow::make_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  check(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "making the window's surface");
  return surface;
}

void GlfwWindow::share_clipboard() {
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = window_;
  io.SetClipboardTextFn = [](void* window, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(window), text);
  };
  io.GetClipboardTextFn = [](void* window) { return glfwGetClipboardString(static_cast<GLFWwindow*>(window)); };
}

void GlfwWindow::press(std::size_t button, bool down) {
  released_late_[button] = !down && pressed_now_[button];
  if (down) pressed_now_[button] = true;
  if (!released_late_[button]) input_.buttons[button] = down;
}

void GlfwWindow::take_events(double seconds) {
  for (std::size_t i = 0; i < released_late_.size(); ++i)
    if (std::exchange(released_late_[i], false)) input_.buttons[i] = false;
  pressed_now_ = {};
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

bool GlfwWindow::wants_to_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

glm::uvec2 GlfwWindow::size() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) return glm::uvec2(0);
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return glm::uvec2(glm::max(size, glm::ivec2(0)));
}

void GlfwWindow::resize(glm::uvec2 size) {
  glfwSetWindowSize(window_, static_cast<int>(size.x), static_cast<int>(size.y));
}

void GlfwWindow::set_minimised(bool minimised) {
  if (minimised)
    glfwIconifyWindow(window_);
  else
    glfwRestoreWindow(window_);
}

float GlfwWindow::content_scale() const {
  glm::vec2 scale(1.0F);
  glfwGetWindowContentScale(window_, &scale.x, &scale.y);
  return scale.x;
}

float GlfwWindow::scale() const { return std::clamp(content_scale(), 1.0F, 4.0F); }

void wake_window() { glfwPostEmptyEvent(); }

}  // namespace lamp::app
