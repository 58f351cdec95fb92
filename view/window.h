// lamp-view on a desktop: a window, and behind it a thread that draws pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "view/script.h"

namespace lamp::app {

struct WindowInfo {
  ViewState state;
  std::vector<Bookmark> bookmarks;
  std::vector<ScriptLine> script;  ///< played with a fixed step of time; then the window closes
  bool plays = false;              ///< there is one
  glm::uvec2 size{1280, 720};
  ContextInfo::Validation validation = ContextInfo::Validation::off;
  std::string said;                                          ///< on the first screen, if something
  std::function<void(const ViewState&, glm::uvec2)> closed;  ///< told the state and the window's size at the end
};

/// Until the window is closed. Throws Error; with Exit::no_device where there is no display or the device cannot
/// present to it.
void run_window(const WindowInfo& info);

}  // namespace lamp::app
