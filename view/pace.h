// Dynamic resolution: how large a picture may be so that the device draws enough of them.
// Promise: pure; the same times give the same sizes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace lamp::app {

class Pace {
 public:
  static constexpr double MOST_REST_MS = 1000.0;

  /// `target_ms`: how long a picture may take; `rest_ms`: the same of one that is drawn once and stays.
  explicit Pace(double target_ms, double rest_ms = MOST_REST_MS) : target_ms_(target_ms), rest_ms_(rest_ms) {}

  /// Of the width and of the height that were asked for.
  [[nodiscard]] double scale() const;
  /// The same of a picture that is drawn once and stays: the largest that is expected to take at most `rest_ms`.
  [[nodiscard]] double rest_scale() const;
  /// A picture of this scale took so long. What compiled or loaded something says nothing, and is not told.
  void took(double ms);

 private:
  double target_ms_;
  double rest_ms_;
  std::size_t step_ = 2;  ///< into the scales, the largest first
  double last_ms_ = 0.0;
  int slow_ = 0;  ///< pictures in a row
  int quick_ = 0;
};

}  // namespace lamp::app
