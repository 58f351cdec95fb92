// What a plan leaves behind: the look-up's resources, and the counts that are read back.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cstring>

#include "lamplight/vulkan/plan_runner.h"
#include "pass_use.h"

namespace lamp::vulkan {

namespace {

/// Of one view: counters, then what each capacity needed.
std::uint64_t view_count_bytes(const Plan& plan) {
  return sizeof(shared::Counters) + plan.capacities.size() * sizeof(std::uint32_t);
}

void add_counters(shared::Counters& to, const shared::Counters& counters) {
  to.overflowed_cells += counters.overflowed_cells;
  to.entries_needed = std::max(to.entries_needed, counters.entries_needed);
  to.longest_list = std::max(to.longest_list, counters.longest_list);
}

}  // namespace

std::uint64_t count_bytes(const Plan& plan) { return plan.views * view_count_bytes(plan); }

FrameCounts read_counts(const Plan& plan, std::span<const std::byte> bytes) {
  assert(bytes.size() >= count_bytes(plan) && "read what record_counts wrote");
  FrameCounts counts{.needed = std::vector<std::uint32_t>(plan.capacities.size())};
  for (std::uint32_t view = 0; view < plan.views; ++view) {
    std::span<const std::byte> of_view = bytes.subspan(view * view_count_bytes(plan), view_count_bytes(plan));
    shared::Counters counters{};
    std::memcpy(&counters, of_view.data(), sizeof(counters));
    add_counters(counts.counters, counters);
    of_view = of_view.subspan(sizeof(counters));
    for (std::size_t i = 0; i < counts.needed.size(); ++i) {
      std::uint32_t needed = 0;
      std::memcpy(&needed, of_view.subspan(i * sizeof(needed)).data(), sizeof(needed));
      counts.needed[i] = std::max(counts.needed[i], needed);
    }
  }
  return counts;
}

void PlanRunner::record_counts(Recorder& recorder, const Buffer& to, std::uint64_t offset) {
  if (plan_.counters == NO_RESOURCE) return;
  const Resource target = Resource::storage(to.handle());
  const auto read = [](const BufferPart& part) {
    return Use{.resource = Resource::storage(part),
               .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
               .access = VK_ACCESS_2_TRANSFER_READ_BIT};
  };
  uses_.assign({{.resource = target, .stages = VK_PIPELINE_STAGE_2_COPY_BIT, .access = VK_ACCESS_2_TRANSFER_WRITE_BIT},
                read(part(plan_.counters, 0))});
  for (const Capacity& capacity : plan_.capacities) uses_.push_back(read(part(capacity.needed, 0)));
  recorder.barrier(uses_);
  const auto copy = [&](const BufferPart& from, std::uint64_t at, std::uint64_t bytes) {
    const VkBufferCopy region{.srcOffset = from.offset + at, .dstOffset = offset, .size = bytes};
    recorder.device().vk.vkCmdCopyBuffer(recorder.commands(), from.buffer, to.handle(), 1, &region);
    offset += bytes;
  };
  for (std::uint32_t view = 0; view < plan_.views; ++view) {
    copy(part(plan_.counters, view), 0, sizeof(shared::Counters));
    for (const Capacity& capacity : plan_.capacities)
      copy(part(capacity.needed, view), capacity.needed_offset, sizeof(std::uint32_t));
  }
  recorder.barrier({{.resource = target, .stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT}});
}

BoundLookUp PlanRunner::lookup(const PlanInputs& inputs, Passes which, std::uint32_t view) const {
  const bool fused = which == Passes::fused;
  const LookUp& lookup = fused ? plan_.fused->lookup : plan_.lookup;
  BoundLookUp bound{.name = lookup.name, .constants = lookup_constants(lookup)};
  for (std::uint32_t i = 0; i < lookup.bindings.size(); ++i) {
    const auto [id, access] = lookup.bindings[i];
    const Resource used = fused ? resource(id, inputs, view) : all_views(id, inputs);
    bound.resources.push_back({LOOKUP_BINDING + i, used});
    bound.uses.push_back(use_of(used, access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
  }
  return bound;
}

}  // namespace lamp::vulkan
