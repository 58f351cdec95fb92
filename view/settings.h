// What a user set up and finds again in the next window: colours, panels, marks, speed, size. A file in the user's
// configuration folder.
// Promise: never what is drawn: the same command line shows the same scene with the same method.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "commands/view_state.h"

namespace lamp::app {

struct Settings {
  Palette palette = Palette::rainbow;
  LightMarks light_marks = LightMarks::none;
  bool panels = true;
  float speed = 1.0F;
  float resolution = 0.0F;
  glm::uvec2 screen{1280, 720};
};

/// $XDG_CONFIG_HOME/lamplight/lamp-view.json, or that below ~/.config; empty where there is no home.
[[nodiscard]] std::filesystem::path settings_file();

/// The size that a window of so many pixels is asked for with: the desktop multiplies it by its scale.
[[nodiscard]] glm::uvec2 unscaled(glm::uvec2 pixels, float scale);

[[nodiscard]] Settings settings_of(const ViewState& state, glm::uvec2 screen);
void apply(const Settings& settings, ViewState& state);

/// Those of the file; the defaults if there is none. Throws Error for a file that holds something else.
[[nodiscard]] Settings load_settings(const std::filesystem::path& file);
/// Throws Error when it cannot be written.
void save_settings(const std::filesystem::path& file, const Settings& settings);

}  // namespace lamp::app
