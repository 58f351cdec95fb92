// Paths to positions.
// SPDX-License-Identifier: Apache-2.0
#include "view/frame_lights.h"

namespace lamp::app {

const std::vector<shared::Light>& FrameLights::all() const {
  std::call_once(once_, [&] {
    lights_ = moving_->lights;
    for (std::size_t i = 0; i < moving_->paths.size(); ++i)
      lights_[moving_->first + i].position = position_at(moving_->paths[i], time_);
  });
  return lights_;
}

void apply_edits(const ViewState& state, MovingLights& moving) {
  apply_edits(state, std::span(moving.lights));
  for (const LightEdit& edit : state.edits) {
    const std::size_t path = edit.light - std::size_t{moving.first};
    if (edit.light >= moving.first && path < moving.paths.size()) moving.paths[path] = resting_at(edit.value.position);
  }
}

}  // namespace lamp::app
