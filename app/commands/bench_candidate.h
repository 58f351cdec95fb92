// An entry of a group while it is measured.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/bench_check.h"
#include "commands/bench_measure.h"
#include "commands/request.h"
#include "render/frame_times.h"

namespace lamp::app {

struct Candidate {
  const GroupEntry* entry = nullptr;
  std::optional<Lighting> lighting;  ///< nothing: it cannot run here
  std::optional<StillSetup> still;   ///< where lights that stand still have lists of their own
  std::unique_ptr<StillLists> still_lists;
  Checked checked;
  FrameTimes times;
  std::vector<std::pair<std::uint32_t, std::size_t>> frames;  ///< number and lights of each timed frame
  bool rendered = true;                                       ///< false: the series asks for its plan alone
  double spent_ms = 0.0;                                      ///< GPU time of all frames, those of the warm-up too
  bool clock_moved = false;                                   ///< while it was timed, each time
  nlohmann::json pictures;                                    ///< files, where there are any

  [[nodiscard]] bool runs() const { return lighting && rendered && checked.verdict != "wrong"; }
  [[nodiscard]] bool timed() const { return runs() && !clock_moved; }
  void forget_times(std::size_t planned) {
    times = FrameTimes(planned);
    frames.clear();
    spent_ms = 0.0;
  }
};

/// Of each timed frame.
[[nodiscard]] std::vector<double> values_of(const FrameTimes& times, const auto& value) {
  std::vector<double> values;
  for (const FrameTime& frame : times.frames()) values.push_back(value(frame));
  return values;
}

[[nodiscard]] inline double cull_and_shade(const FrameTime& frame) { return frame.cull_ms + frame.shade_ms; }

[[nodiscard]] bool has_auto(const Group& group);

/// The label, and what tells entries of one label apart.
[[nodiscard]] std::string full_label(const GroupEntry& entry);

/// Shows what is done. Throws Interrupted where a signal wants it to stop.
void say(const MeasureInfo& info, const std::string& what, double share);

/// As results.json holds it; `frame`: the one that was checked.
[[nodiscard]] nlohmann::json result_json(const MeasureInfo& info, Candidate& candidate, const BenchFrame& frame);

/// Times all candidates that run, round by round. A group whose clock moved is timed again. Times of a clock that does
/// not stand still are no one's: they are left out. A flight's frames differ by themselves.
void time_group(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, std::list<Candidate>& candidates);

}  // namespace lamp::app
