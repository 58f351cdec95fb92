// Turns depth around.
// SPDX-License-Identifier: Apache-2.0
#include "render/host_depth.h"

#include "gpu/check.h"

namespace lamp::app {

View with_standard_depth(const View& view) {
  return take(View::create(view.width(), view.height(), flip_depth(view.clip_from_view()), view.view_from_world()));
}

}  // namespace lamp::app
