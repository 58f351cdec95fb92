// Decides, frame by frame, which reflection probes are captured anew.
// Promise: pure code, no device. Whatever waits is counted. No probe waits for ever: see `MOST_WEIGHT`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lamp::app {

/// A probe of the frame.
struct ProbeDemand {
  float share = 0.0F;    ///< of the picture that it may light, 0 .. 1
  bool changed = false;  ///< what it sees is not what it was: lights or geometry moved, or the probe itself
};

struct ProbeFrameInfo {
  std::span<const ProbeDemand> probes;  ///< by id, as many in every frame as the schedule was made for
  std::uint32_t budget = std::numeric_limits<std::uint32_t>::max();  ///< captures in this frame, at most
};

struct ProbeCounts {
  std::uint32_t captured = 0;      ///< have a capture, old or new
  std::uint32_t waiting = 0;       ///< are to be captured, and the budget does not allow it
  std::uint32_t drawn = 0;         ///< captured in this frame
  std::uint32_t longest_wait = 0;  ///< frames, of those that wait
};

struct ProbeFrame {
  std::vector<std::uint32_t> draws;  ///< probes, in the order of their priority
  ProbeCounts counts;
};

class ProbeSchedule {
 public:
  /// Probes that have a capture go by frames waited times a weight of 1 (the least share) to this (the largest): of n
  /// probes and a budget of b a frame, none waits more than MOST_WEIGHT * (n / b + 1) frames once all have a capture.
  static constexpr float MOST_WEIGHT = 16.0F;

  explicit ProbeSchedule(std::uint32_t probes) : states_(probes) {}

  /// What the frame captures. It is taken as done.
  [[nodiscard]] ProbeFrame schedule(const ProbeFrameInfo& frame);

 private:
  struct State {
    bool captured = false;
    bool changed = false;      ///< since its capture
    std::uint32_t waited = 0;  ///< frames in which it was to be captured, and was not
    float share = 0.0F;
  };
  [[nodiscard]] std::vector<std::uint32_t> to_draw() const;
  [[nodiscard]] float priority(std::uint32_t probe) const;

  std::vector<State> states_;
};

}  // namespace lamp::app
