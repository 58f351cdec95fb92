// Draws progress.
// SPDX-License-Identifier: Apache-2.0
#include "system/progress.h"

#include <fmt/format.h>

#include "system/print.h"

namespace lamp::app {

Progress::Progress() : terminal_(shows_progress()), start_(Clock::now()), drawn_(start_) {}

void Progress::show(const std::string& text, double done) {
  const Clock::time_point now = Clock::now();
  if (!terminal_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left = done > 0.02 ? about(elapsed * (1.0 - done) / done) + " left" : "";
  print_error("\r\033[K{:3.0f} %  {}  {}", 100.0 * done, text, left);
}

void Progress::clear() const {
  if (drawn_ != start_) print_error("\r\033[K");
}

void show_progress(std::string_view text) {
  if (shows_progress()) print_error("\r\033[K{}", text);
}

std::string about(double seconds) {
  if (seconds < 90.0) return fmt::format("about {:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("about {:.0f} min", seconds / 60.0);
  return fmt::format("about {:.0f} h", seconds / 3600.0);
}

}  // namespace lamp::app
