// Names of keys.
// SPDX-License-Identifier: Apache-2.0
#include "view/input.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 67> KEYS{
    "a",       "b",         "c",     "d",      "e",     "f",      "g",         "h",      "i",    "j",
    "k",       "l",         "m",     "n",      "o",     "p",      "q",         "r",      "s",    "t",
    "u",       "v",         "w",     "x",      "y",     "z",      "0",         "1",      "2",    "3",
    "4",       "5",         "6",     "7",      "8",     "9",      "f1",        "f2",     "f3",   "f4",
    "f5",      "f6",        "f7",    "f8",     "f9",    "f10",    "f11",       "f12",    "up",   "down",
    "left",    "right",     "tab",   "space",  "enter", "escape", "backspace", "delete", "home", "end",
    "page-up", "page-down", "comma", "period", "shift", "ctrl",   "alt"};

}  // namespace

std::span<const std::string_view> key_names() { return KEYS; }

std::optional<std::size_t> key_number(std::string_view name) {
  const auto found = std::ranges::find(KEYS, name);
  if (found == KEYS.end()) return std::nullopt;
  return static_cast<std::size_t>(found - KEYS.begin());
}

void Input::next_frame() {
  wheel = glm::vec2(0.0F);
  pressed.clear();
  repeated.clear();
  text.clear();
  dropped.clear();
}

}  // namespace lamp::app
