// The lights of a frame, which the GPU moves: where they are is computed on the CPU only when somebody asks.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "commands/view_state.h"

namespace lamp::app {

class FrameLights {
 public:
  FrameLights(std::shared_ptr<const MovingLights> moving, const PathTime& time)
      : moving_(std::move(moving)), time_(time) {}

  [[nodiscard]] std::size_t size() const { return moving_->lights.size(); }
  /// From any thread.
  [[nodiscard]] const std::vector<shared::Light>& all() const;

 private:
  std::shared_ptr<const MovingLights> moving_;
  PathTime time_;
  mutable std::once_flag once_;
  mutable std::vector<shared::Light> lights_;
};

/// Lights that were changed rest where they were put.
void apply_edits(const ViewState& state, MovingLights& moving);

}  // namespace lamp::app
