// What a plan leaves behind: the look-up's resources, and the counts that are read back.
// SPDX-License-Identifier: Apache-2.0
#include <cassert>
#include <cstring>

#include "lamplight/vulkan/plan_runner.h"
#include "pass_use.h"

namespace lamp::vulkan {

std::uint64_t count_bytes(const Plan& plan) {
  return sizeof(shared::Counters) + plan.capacities.size() * sizeof(std::uint32_t);
}

FrameCounts read_counts(const Plan& plan, std::span<const std::byte> bytes) {
  assert(bytes.size() >= count_bytes(plan) && "read what record_counts wrote");
  FrameCounts counts{.needed = std::vector<std::uint32_t>(plan.capacities.size())};
  std::memcpy(&counts.counters, bytes.data(), sizeof(counts.counters));
  if (!counts.needed.empty())
    std::memcpy(counts.needed.data(), bytes.subspan(sizeof(counts.counters)).data(),
                counts.needed.size() * sizeof(std::uint32_t));
  return counts;
}

Resource PlanRunner::resource(ResourceId id, const PlanInputs& inputs) const {
  switch (id) {
    case INPUT_FRAME:
      return Resource::storage(inputs.frame);
    case INPUT_LIGHTS:
      return Resource::storage(inputs.lights);
    case INPUT_DEPTH: {
      Resource depth = inputs.depth;
      depth.type = descriptor_type(id);
      depth.sampler = depth_sampler_.get();
      return depth;
    }
    case INPUT_CONES:
      return Resource::storage(inputs.cones);
    case INPUT_SPHERES:
      return Resource::storage(inputs.spheres);
    default:
      return Resource::storage(buffer(id));
  }
}

std::vector<Use> BoundLookUp::buffer_uses(VkPipelineStageFlags2 stages) const {
  std::vector<Use> of_buffers;
  for (const Use& use : uses)
    if (use.resource.buffer != VK_NULL_HANDLE) of_buffers.push_back({use.resource, stages, use.access});
  return of_buffers;
}

BoundLookUp PlanRunner::lookup(const PlanInputs& inputs, Passes which) const {
  const LookUp& lookup = which == Passes::fused ? plan_.fused->lookup : plan_.lookup;
  BoundLookUp bound{.name = lookup.name, .constants = lookup_constants(lookup)};
  for (std::uint32_t i = 0; i < lookup.bindings.size(); ++i) {
    const Resource used = resource(lookup.bindings[i].resource, inputs);
    bound.resources.push_back({LOOKUP_BINDING + i, used});
    bound.uses.push_back(use_of(used, lookup.bindings[i].access, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
  }
  return bound;
}

}  // namespace lamp::vulkan
