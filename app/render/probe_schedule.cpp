// Probes by priority, as many as the budget allows.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_schedule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace lamp::app {

ProbeFrame ProbeSchedule::schedule(const ProbeFrameInfo& frame) {
  assert(frame.probes.size() == states_.size() && "make a schedule for another number of probes");
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe) {
    const ProbeDemand& demand = frame.probes[probe];
    assert(std::isfinite(demand.share) && "a share of the picture is a number");
    states_[probe].changed = states_[probe].changed || demand.changed;
    states_[probe].share = std::min(demand.share, 1.0F);
  }
  ProbeFrame result;
  for (const std::uint32_t probe : to_draw()) {
    State& state = states_[probe];
    if (result.draws.size() < frame.budget) {
      state = {.captured = true, .share = state.share};
      result.draws.push_back(probe);
      continue;
    }
    ++state.waited;
    ++result.counts.waiting;
    result.counts.longest_wait = std::max(result.counts.longest_wait, state.waited);
  }
  result.counts.drawn = static_cast<std::uint32_t>(result.draws.size());
  result.counts.captured = static_cast<std::uint32_t>(std::ranges::count(states_, true, &State::captured));
  return result;
}

float ProbeSchedule::priority(std::uint32_t probe) const {
  const State& state = states_[probe];
  const float weight = 1.0F + (MOST_WEIGHT - 1.0F) * state.share;
  return weight * static_cast<float>(state.waited + 1);
}

/// Those without a capture come first, by what they light; all others by weight times frames waited.
std::vector<std::uint32_t> ProbeSchedule::to_draw() const {
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe)
    if (!states_[probe].captured || states_[probe].changed) wanted.push_back(probe);
  std::ranges::sort(wanted, {},
                    [&](std::uint32_t probe) { return std::tuple(states_[probe].captured, -priority(probe), probe); });
  return wanted;
}

}  // namespace lamp::app
