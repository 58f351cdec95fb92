// Slots first, then captures.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_schedule.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

namespace lamp::app {

ProbeSchedule::ProbeSchedule(std::uint32_t probes, std::uint32_t slots) : states_(probes), owners_(slots, NO_SLOT) {}

ProbeFrame ProbeSchedule::schedule(const ProbeFrameInfo& frame) {
  assert(frame.probes.size() == states_.size() && "make a schedule for another number of probes");
  ++frame_;
  ProbeFrame result;
  look(frame);
  give_slots(frame.probes, result);
  const std::vector<std::uint32_t> wanted = to_draw(frame.probes);
  for (const std::uint32_t probe : wanted) {
    State& state = states_[probe];
    if (result.draws.size() < frame.budget) {
      state.captured = true;
      state.changed = false;
      state.waited = 0;
      result.draws.push_back({.probe = probe, .slot = state.slot});
      continue;
    }
    ++state.waited;
    result.waiting.push_back(probe);
    result.counts.longest_wait = std::max(result.counts.longest_wait, state.waited);
  }
  result.counts.drawn = static_cast<std::uint32_t>(result.draws.size());
  result.counts.waiting = static_cast<std::uint32_t>(result.waiting.size());
  result.counts.without_slot = static_cast<std::uint32_t>(result.without.size());
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe) {
    if (frame.probes[probe].share <= 0.0F) continue;
    ++result.counts.seen;
    if (states_[probe].captured) ++result.counts.captured;
  }
  return result;
}

void ProbeSchedule::look(const ProbeFrameInfo& frame) {
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe) {
    const ProbeDemand& demand = frame.probes[probe];
    assert(std::isfinite(demand.share) && "a share of the picture is a number");
    State& state = states_[probe];
    state.changed = state.changed || demand.changed;
    if (demand.share <= 0.0F) continue;
    state.last_seen = frame_;
    state.share = std::min(demand.share, 1.0F);
  }
}

/// Those that are seen most come first, so that none of them takes a slot that the next then takes from it.
void ProbeSchedule::give_slots(std::span<const ProbeDemand> probes, ProbeFrame& result) {
  std::vector<std::uint32_t> asking;
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe)
    if (probes[probe].share > 0.0F) asking.push_back(probe);
  std::ranges::sort(asking, {}, [&](std::uint32_t probe) { return std::pair(-states_[probe].share, probe); });
  for (const std::uint32_t probe : asking) {
    if (states_[probe].slot != NO_SLOT) continue;
    const std::uint32_t slot = slot_for(probe, result.counts);
    if (slot == NO_SLOT) continue;
    owners_[slot] = probe;
    states_[probe].slot = slot;
  }
  for (const std::uint32_t probe : asking)
    if (states_[probe].slot == NO_SLOT) result.without.push_back(probe);
}

/// A free one; else that of the probe that was seen least recently, then of the one that is seen least.
std::uint32_t ProbeSchedule::slot_for(std::uint32_t probe, ProbeCounts& counts) {
  if (owners_.empty()) return NO_SLOT;
  const auto rank = [&](std::uint32_t owner) {
    return owner == NO_SLOT ? std::tuple(std::uint64_t{0}, -1.0F)
                            : std::tuple(states_[owner].last_seen, states_[owner].share);
  };
  const auto least = std::ranges::min_element(owners_, {}, rank);
  if (*least != NO_SLOT) {
    State& owner = states_[*least];
    if (owner.last_seen == frame_ && states_[probe].share < LARGER_SHARE * owner.share) return NO_SLOT;
    owner.slot = NO_SLOT;
    owner.captured = false;
    owner.waited = 0;
    ++counts.evicted;
  }
  return static_cast<std::uint32_t>(least - owners_.begin());
}

float ProbeSchedule::priority(std::uint32_t probe) const {
  const State& state = states_[probe];
  const float weight = 1.0F + (MOST_WEIGHT - 1.0F) * state.share;
  return weight * static_cast<float>(state.waited + 1);
}

/// Those without a capture come first, by what they light; all others by weight times frames waited.
std::vector<std::uint32_t> ProbeSchedule::to_draw(std::span<const ProbeDemand> probes) const {
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t probe = 0; probe < states_.size(); ++probe) {
    const State& state = states_[probe];
    if (probes[probe].share > 0.0F && state.slot != NO_SLOT && (!state.captured || state.changed))
      wanted.push_back(probe);
  }
  std::ranges::sort(wanted, {},
                    [&](std::uint32_t probe) { return std::tuple(states_[probe].captured, -priority(probe), probe); });
  return wanted;
}

}  // namespace lamp::app
