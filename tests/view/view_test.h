// What tests of the window's parts share: one device with validation on, and a viewer of a picture that takes no time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "view/headless.h"

namespace lamp::app {

[[nodiscard]] Context& view_context();

/// A plane of 96 x 54 pixels with 32 lights, tiled, that stands still, on a screen of 720 x 480.
[[nodiscard]] HeadlessInfo small_viewer();

}  // namespace lamp::app
