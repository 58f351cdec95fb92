// Times of passes over many frames: samples in, medians and percentiles out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/vulkan.h"

namespace lamp::app {

class Lighting;
struct Rendered;

/// The sample at a share 0 .. 1 of the sorted samples (nearest rank); 0 when there are none.
[[nodiscard]] double percentile(std::vector<double> samples, double share);

/// From the beginning of the first to the end of the last pass that counts, milliseconds; without the time of passes in
/// between that do not.
[[nodiscard]] double span_ms(std::span<const vulkan::Timestamps::Time> times,
                             const std::function<bool(std::string_view)>& counts);

/// One frame, milliseconds.
struct FrameTime {
  double cull_ms = 0.0;  ///< the plan: from the clearing of its buffers to the end of its last pass
  double shade_ms = 0.0;
  double frame_ms = 0.0;  ///< all passes
};

/// Sorts the frames' timestamps by pass.
class FrameTimes {
 public:
  void add(const std::vector<vulkan::Timestamps::Time>& times, const Lighting& lighting);
  /// Passes, host passes first, else in the order of the first frame, and the medians of the frames' sums.
  void fill(Rendered& rendered, const Lighting& lighting) const;
  [[nodiscard]] const std::vector<FrameTime>& frames() const { return frames_; }

 private:
  struct Samples {
    std::string pass;
    bool host = false;
    std::vector<double> ms;
  };
  void add_sample(const std::string& pass, bool host, double ms);

  std::vector<Samples> samples_;  ///< in the order of the first frame, host passes first
  std::vector<FrameTime> frames_;
};

}  // namespace lamp::app
