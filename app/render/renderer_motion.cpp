// What moves between frames that are otherwise the same: instances of the scene, and lights that the GPU moves.
// SPDX-License-Identifier: Apache-2.0
#include <cassert>

#include "render/renderer.h"

namespace lamp::app {

void Renderer::move_instances(std::span<const shared::LightSphere> moved) {
  views_.clear();  // whatever is drawn is of before
  forget_surfaces();
  if (mirror_) mirror_->move(context_);
  if (shadows_) shadows_->move(moved);
}

void Renderer::move_frame(const View& view, const LightMover& mover, const PathTime& time) {
  assert(!all_pictures_ && !shadows_ && !mirror_ && still_ == nullptr && "lights move on the GPU alone");
  if (views_.size() != 1 || views_.front() != view) forget_surfaces();
  views_ = {view};
  shown_view_ = view;
  data_.set_view(view);
  mover_ = &mover;
  time_ = time;
}

}  // namespace lamp::app
