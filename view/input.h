// What a user does in a frame: the same from a window and from a script.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamp::app {

/// Names of keys, as scripts and the help have them: "a" .. "z", "0" .. "9", "space", "ctrl", "left", ...
[[nodiscard]] std::span<const std::string_view> key_names();
/// Its place among them; nothing for a name that is none.
[[nodiscard]] std::optional<std::size_t> key_number(std::string_view name);

struct Input {
  std::optional<glm::vec2> mouse;           ///< pixels of the screen; nothing: outside
  std::array<bool, 3> buttons{};            ///< held: left, right, middle
  glm::vec2 wheel{0.0F};                    ///< steps, in this frame
  std::set<std::string, std::less<>> held;  ///< keys
  std::vector<std::string> pressed;         ///< keys that went down in this frame
  std::vector<std::string> repeated;        ///< keys that are held, and that the desktop repeats in this frame
  std::string text;                         ///< typed, UTF-8
  std::vector<std::string> dropped;         ///< files

  [[nodiscard]] bool holds(std::string_view key) const { return held.contains(key); }
  /// Forgets what belongs to one frame.
  void next_frame();
};

}  // namespace lamp::app
