// Times of passes over many frames: samples in, medians and percentiles out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lamplight/vulkan.h"

namespace lamp::app {

class Lighting;
struct Rendered;

/// At a share 0 .. 1 of the way through the sorted samples, between two of them in proportion; 0 when there are none.
[[nodiscard]] double percentile(std::vector<double> samples, double share);

/// From the beginning of the first to the end of the last pass that counts, milliseconds; without the time of passes in
/// between that do not.
[[nodiscard]] double span_ms(std::span<const vulkan::Timestamps::Time> times,
                             const std::function<bool(std::string_view)>& counts);

/// Of all passes.
[[nodiscard]] double span_ms(std::span<const vulkan::Timestamps::Time> times);

/// One frame, milliseconds.
struct FrameTime {
  double cull_ms = 0.0;  ///< the plan: from the clearing of its buffers to the end of its last pass
  double shade_ms = 0.0;
  double frame_ms = 0.0;  ///< all passes
};

/// What a frame's timestamps tell: every pass, or its parts alone (cull, shading, the rest), which takes no time of
/// the passes in between.
enum class Timing : std::uint8_t { passes, parts };

/// Which part a pass is of, for `Timestamps`; nothing if every pass is to be told.
[[nodiscard]] vulkan::Timestamps::PartOf parts_of(const Lighting& lighting, Timing timing);

/// Milliseconds of each pass of a frame, in the order of their first runs.
using PassSums = std::vector<std::pair<std::string, double>>;
/// A run of a pass: of several in a frame, as for each view, it takes the sum.
void add_to(PassSums& sums, std::string_view pass, double ms);

/// Sorts the frames' timestamps by pass and by part.
class FrameTimes {
 public:
  /// Of many frames every fourth tells its passes, the others their parts; few frames tell both, from their passes.
  explicit FrameTimes(std::size_t planned = 1) : takes_turns_(planned >= 4) {}
  /// What the next frame is to tell.
  [[nodiscard]] Timing next() const { return takes_turns_ && added_ % 4 != 1 ? Timing::parts : Timing::passes; }
  void add(const std::vector<vulkan::Timestamps::Time>& times, const Lighting& lighting);
  /// Passes, host passes first, else in the order of the first frame, and the medians of the frames' sums.
  void fill(Rendered& rendered, const Lighting& lighting) const;
  /// Of those frames that told their parts.
  [[nodiscard]] const std::vector<FrameTime>& frames() const { return frames_; }

 private:
  struct Samples {
    std::string pass;
    bool host = false;
    std::vector<double> ms;
  };
  void add_sample(const std::string& pass, bool host, double ms);

  bool takes_turns_;
  std::size_t added_ = 0;         ///< frames
  std::vector<Samples> samples_;  ///< in the order of the first frame, host passes first
  std::vector<FrameTime> frames_;
};

}  // namespace lamp::app
