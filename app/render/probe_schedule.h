// Decides, frame by frame, which reflection probe has which slot of the atlas, and which are captured anew.
// Promise: pure code, no device. A probe that is seen keeps its slot from one that is seen as much. Whatever waits is
// counted and named. No probe with a slot waits for ever: see `MOST_WEIGHT`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lamp::app {

/// A probe of the frame.
struct ProbeDemand {
  float share = 0.0F;    ///< of the picture that it may light, 0 .. 1; 0: nobody sees it
  bool changed = false;  ///< what it sees is not what it was: lights or geometry moved, or the probe itself
};

struct ProbeFrameInfo {
  std::span<const ProbeDemand> probes;  ///< by id, as many in every frame as the schedule was made for
  std::uint32_t budget = std::numeric_limits<std::uint32_t>::max();  ///< captures in this frame, at most
};

/// Of the probes that are seen, where not said otherwise.
struct ProbeCounts {
  std::uint32_t seen = 0;
  std::uint32_t captured = 0;      ///< have a capture, old or new
  std::uint32_t without_slot = 0;  ///< the atlas is full of probes that are seen as much
  std::uint32_t waiting = 0;       ///< have a slot and are to be captured, and the budget does not allow it
  std::uint32_t drawn = 0;         ///< captured in this frame
  std::uint32_t evicted = 0;       ///< lost their slot in this frame, seen or not
  std::uint32_t longest_wait = 0;  ///< frames, of those that wait
};

struct ProbeDraw {
  std::uint32_t probe = 0;
  std::uint32_t slot = 0;
};

struct ProbeFrame {
  std::vector<ProbeDraw> draws;        ///< in the order of their priority
  std::vector<std::uint32_t> waiting;  ///< probes, as counted
  std::vector<std::uint32_t> without;  ///< likewise
  ProbeCounts counts;
};

class ProbeSchedule {
 public:
  static constexpr std::uint32_t NO_SLOT = ~0U;
  /// A probe takes the slot of one that is seen only if its share is so many times as large: else two would take turns.
  static constexpr float LARGER_SHARE = 2.0F;
  /// Probes that have a capture go by frames waited times a weight of 1 (the least share) to this (the largest): of n
  /// slots and a budget of b a frame, none waits more than MOST_WEIGHT * (n / b + 1) frames once all have a capture.
  static constexpr float MOST_WEIGHT = 16.0F;

  ProbeSchedule(std::uint32_t probes, std::uint32_t slots);

  /// What the frame captures. It is taken as done.
  [[nodiscard]] ProbeFrame schedule(const ProbeFrameInfo& frame);

  /// The slot whose capture a probe shows; NO_SLOT before its first.
  [[nodiscard]] std::uint32_t slot(std::uint32_t probe) const {
    return states_[probe].captured ? states_[probe].slot : NO_SLOT;
  }

 private:
  struct State {
    std::uint32_t slot = NO_SLOT;
    bool captured = false;
    bool changed = false;         ///< since its capture
    std::uint32_t waited = 0;     ///< frames in which it was to be captured, seen, and was not
    std::uint64_t last_seen = 0;  ///< frame
    float share = 0.0F;           ///< when it was last seen
  };
  void look(const ProbeFrameInfo& frame);
  void give_slots(std::span<const ProbeDemand> probes, ProbeFrame& result);
  [[nodiscard]] std::uint32_t slot_for(std::uint32_t probe, ProbeCounts& counts);
  [[nodiscard]] std::vector<std::uint32_t> to_draw(std::span<const ProbeDemand> probes) const;
  [[nodiscard]] float priority(std::uint32_t probe) const;

  std::vector<State> states_;
  std::vector<std::uint32_t> owners_;  ///< of slots: a probe, or NO_SLOT
  std::uint64_t frame_ = 0;
};

}  // namespace lamp::app
