// Buffers and passes that several methods put into their plans.
// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

namespace lamp::parts {

ResourceId add_light_bounds(Plan& plan, const Problem& problem) {
  return plan.add({.name = "light bounds", .bytes = std::uint64_t{capacity(problem)} * sizeof(shared::LightBounds)});
}

Pass light_bounds_pass(ResourceId bounds) {
  return {.name = "light bounds",
          .shader = "methods/light_bounds",
          .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {bounds, Access::write}},
          .extent = {.lights_per_group = 64}};
}

ResourceId add_counters(Plan& plan) {
  plan.counters = plan.add({.name = "counters", .bytes = sizeof(shared::Counters), .zeroed = true});
  return plan.counters;
}

}  // namespace lamp::parts
