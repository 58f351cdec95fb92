// lamp-view --headless: plays on a screen that nobody sees, with a fixed step of time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "gpu/context.h"
#include "view/pace.h"
#include "view/script.h"

namespace lamp::app {

struct HeadlessInfo {
  ViewState state;
  glm::uvec2 screen{1280, 720};
  std::vector<Bookmark> bookmarks;
  double target_ms = 0.0;  ///< as ViewerInfo's
  double rest_ms = Pace::MOST_REST_MS;
};

/// Draws a first frame, then lets `use` play. Throws Error; with Exit::check_failed where validation says something.
void run_headless(Context& context, const HeadlessInfo& info, const std::function<void(Player&)>& use);

}  // namespace lamp::app
