// A few fixed scales, so that plans and pipelines of each are made once.
// SPDX-License-Identifier: Apache-2.0
#include "view/pace.h"

#include <algorithm>
#include <array>

namespace lamp::app {
namespace {

constexpr std::array<double, 7> SCALES{1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
constexpr int SLOW_PICTURES = 2;    // before it becomes smaller: one alone may be the machine's
constexpr int QUICK_PICTURES = 12;  // before it becomes larger: about a second
constexpr double WITH_ROOM = 0.8;   // of the target, that the next larger one is expected to take

double pixels(std::size_t step) { return SCALES[step] * SCALES[step]; }

}  // namespace

double Pace::scale() const { return SCALES[step_]; }

double Pace::rest_scale() const {
  for (std::size_t step = 0; step < step_; ++step)
    if (last_ms_ * pixels(step) / pixels(step_) <= rest_ms_) return SCALES[step];
  return scale();
}

void Pace::took(double ms) {
  last_ms_ = ms;
  slow_ = ms > target_ms_ ? slow_ + 1 : 0;
  const bool larger_fits = step_ > 0 && ms * pixels(step_ - 1) / pixels(step_) < WITH_ROOM * target_ms_;
  quick_ = larger_fits ? quick_ + 1 : 0;
  if (slow_ >= SLOW_PICTURES && step_ + 1 < SCALES.size()) {
    ++step_;
    slow_ = quick_ = 0;
  }
  if (quick_ >= QUICK_PICTURES) {
    --step_;
    slow_ = quick_ = 0;
  }
}

}  // namespace lamp::app
