// What a plan leaves behind: the look-up's resources, and the counts that are read back.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "lamplight/vulkan/plan_runner.h"
#include "pass_use.h"

namespace lamp::vulkan {

namespace {

void add_counters(shared::Counters& to, const shared::Counters& counters) {
  to.overflowed_cells += counters.overflowed_cells;
  to.entries_needed = std::max(to.entries_needed, counters.entries_needed);
  to.longest_list = std::max(to.longest_list, counters.longest_list);
}

template <class T>
T value_at(std::span<const std::byte> bytes, std::uint64_t offset) {
  T value{};
  std::memcpy(&value, bytes.subspan(offset, sizeof(value)).data(), sizeof(value));
  return value;
}

}  // namespace

void PlanRunner::record_counts(Recorder& recorder) {
  if (plan_.counters == NO_RESOURCE) return;
  recorder.barrier({{.resource = Resource::storage(buffer(plan_.counters)),
                     .stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                     .access = VK_ACCESS_2_HOST_READ_BIT}});
}

/// Of all views; none of a plan without counters.
std::span<std::byte> PlanRunner::count_bytes(std::uint32_t slot) const {
  if (plan_.counters == NO_RESOURCE) return {};
  const std::uint64_t bytes = plan_.all_bytes(plan_.buffers[plan_.counters - PLAN_BUFFER]);
  return buffers_[plan_.counters - PLAN_BUFFER].mapped().subspan(slot * bytes, bytes);
}

FrameCounts PlanRunner::counts(std::uint32_t slot) const {
  FrameCounts counts{.needed = std::vector<std::uint32_t>(plan_.capacities.size())};
  if (plan_.counters == NO_RESOURCE) return counts;
  const std::span<const std::byte> bytes = count_bytes(slot);
  for (std::uint32_t view = 0; view < plan_.views; ++view) {
    const std::uint64_t begin = view * plan_.view_bytes(plan_.buffers[plan_.counters - PLAN_BUFFER]);
    add_counters(counts.counters, value_at<shared::Counters>(bytes, begin));
    for (std::size_t i = 0; i < counts.needed.size(); ++i)
      counts.needed[i] =
          std::max(counts.needed[i], value_at<std::uint32_t>(bytes, begin + plan_.capacities[i].needed_offset));
  }
  return counts;
}

BoundLookUp PlanRunner::lookup(const PlanInputs& inputs, Passes which, std::uint32_t view) const {
  const bool fused = which == Passes::fused;
  const LookUp& lookup = fused ? plan_.fused->lookup : plan_.lookup;
  BoundLookUp bound{.name = lookup.name, .constants = lookup_constants(lookup), .addressable = addressable_};
  for (std::uint32_t i = 0; i < lookup.bindings.size(); ++i) {
    const auto [id, access] = lookup.bindings[i];
    const Resource used = fused ? resource(id, inputs, view) : all_views(id, inputs);
    bound.resources.push_back({LOOKUP_BINDING + i, used});
    bound.uses.push_back(use_of(used, access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
  }
  return bound;
}

}  // namespace lamp::vulkan
