// Renders until the GPU is awake. SPDX-License-Identifier: Apache-2.0
#include "render/wake.h"

#include <algorithm>

#include "render/frame_times.h"
#include "render/renderer.h"

namespace lamp::app {
namespace {

constexpr double LONG_WAIT_MS = 5.0;
// The longer a GPU waits, the deeper it sleeps: an H200 that waited for seconds is at a sixth of its clock, and 50 ms
// of work do not wake it.
constexpr double LEAST_WAKE_MS = 50.0;
constexpr double MOST_WAKE_MS = 1000.0;

}  // namespace

void wake(Renderer& renderer, Lighting& lighting, double waited_ms) {
  if (waited_ms < LONG_WAIT_MS) return;
  const double enough_ms = std::clamp(waited_ms, LEAST_WAKE_MS, MOST_WAKE_MS);
  for (double ms = 0.0; ms < enough_ms;) ms += span_ms(renderer.time(lighting, Timing::parts));
}

}  // namespace lamp::app
