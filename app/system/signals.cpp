// What asks whether a signal came, and the thread that it comes to, share one state.
// SPDX-License-Identifier: Apache-2.0
#include "system/signals.h"

#include <chrono>
#include <mutex>

#include "system/print.h"

namespace lamp::app {
namespace {

using Clock = std::chrono::steady_clock;

struct Stopping {
  std::mutex mutex;
  bool asked_for = false;  ///< a StopRequest exists
  int signal = 0;
  Clock::time_point came;
};

/// Never destroyed: the thread that waits outlives main.
Stopping& stopping() {
  static Stopping& one = *new Stopping;
  return one;
}

}  // namespace

StopRequest::StopRequest() {
  const std::scoped_lock lock(stopping().mutex);
  stopping().asked_for = true;
  stopping().signal = 0;
}

StopRequest::~StopRequest() {
  const std::scoped_lock lock(stopping().mutex);
  stopping().asked_for = false;
}

int StopRequest::signal() {
  const std::scoped_lock lock(stopping().mutex);
  return stopping().signal;
}

bool StopRequest::takes(int signal) {
  Stopping& s = stopping();
  const std::scoped_lock lock(s.mutex);
  if (!s.asked_for) return false;
  const Clock::time_point now = Clock::now();
  if (s.signal == 0) {
    s.signal = signal;
    s.came = now;
    if (shows_progress()) write_error("\nstops after what it is at; the signal again ends it at once\n");
    return true;
  }
  // Shells and `timeout` may send one signal twice, to the process and to its group: only a later one is impatience.
  return now - s.came < std::chrono::seconds(1);
}

}  // namespace lamp::app
