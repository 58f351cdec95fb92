// Progress of long work: one line on a terminal, with the time left; nothing in a pipe.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace lamp::app {

class Progress {
 public:
  Progress();
  /// `done` of all work, 0 .. 1. Cheap to call often: draws at most ten times a second.
  void show(const std::string& text, double done);
  /// Takes the line away, if there is one.
  void clear() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  Clock::time_point start_;
  Clock::time_point drawn_;
};

/// A line of progress without an end in sight, in place of the last one; empty: takes it away. Nothing where none is
/// shown.
void show_progress(std::string_view text);

/// "about 40 s", "about 3 min", "about 2 h".
[[nodiscard]] std::string about(double seconds);

}  // namespace lamp::app
