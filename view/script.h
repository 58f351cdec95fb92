// Scripts: lines of JSON, each with one thing that a user could do, or that somebody expects to see.
// Promise: a script is read and checked as a whole before its first line is done.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/image.h"
#include "view/input.h"
#include "view/viewer.h"

namespace lamp::app {

/// A line. `what` is one of:
///   {"set": {...}}                   members of a state, as in its file
///   {"wait": 3} or {"wait": "idle"}  frames, or until all that was asked for is done and shown
///   {"click": "LABEL"} or [x, y]     a widget by its label, or a pixel of the screen
///   {"click_picture": [x, y]}        a place in the picture, 0 .. 1
///   {"drag": [[x, y], [x, y]]}       pixels of the screen, or of the picture with "drag_picture", 0 .. 1
///   {"scroll": [x, y]}               steps of the wheel
///   {"key": "ctrl+z"}                pressed and released; {"hold": "w", "frames": 5}
///   {"type": "text"}
///   {"clipboard": "text"}            puts it there
///   {"drop": "FILE"}
///   {"resize": [w, h]}               the screen
///   {"minimise": 2}                  for frames
///   {"expect": {"/POINTER": value}}  of Viewer::report(); a text that begins with "~" is a part of one
///   {"save_picture": "FILE"} {"save_state": "FILE"} {"save_screen": "FILE.png"}
struct ScriptLine {
  std::string name;  ///< "demo.jsonl: line 3", for errors
  std::string what;
  nlohmann::json value;
  nlohmann::json line;
};
/// Throws Error for a line that is none.
[[nodiscard]] std::vector<ScriptLine> read_script(const std::filesystem::path& file);
[[nodiscard]] std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name);

/// Where a script is played: a screen that draws one frame after the other.
struct Player {
  Viewer& viewer;
  Input& input;
  std::function<void()> frame;             ///< draws one, with the input as it is, and forgets what belongs to it
  std::function<void(glm::uvec2)> resize;  ///< the screen; (0, 0): minimised
  std::function<LdrImage()> screen;        ///< what the last frame drew
  glm::uvec2 size{0};                      ///< of the screen
};
/// Throws Error at the first line that cannot be done, and with Exit::check_failed at the first expectation that is not
/// met.
void play(Player& player, const std::vector<ScriptLine>& script);

}  // namespace lamp::app
