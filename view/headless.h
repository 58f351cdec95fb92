// lamp-view --headless: plays a script on a screen that nobody sees, with a fixed step of time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gpu/context.h"
#include "view/script.h"

namespace lamp::app {

struct HeadlessInfo {
  ViewState state;
  std::vector<ScriptLine> script;
  glm::uvec2 screen{1280, 720};
};

/// Throws Error; with Exit::check_failed where the script expects something else, or validation says something.
void run_headless(Context& context, const HeadlessInfo& info);

}  // namespace lamp::app
