// Spheres of a plan's own: a buffer, a pass, and every binding of the input turned to the buffer.
// SPDX-License-Identifier: Apache-2.0
#include "own_spheres.h"

#include <algorithm>
#include <bit>

namespace lamp {
namespace {

constexpr std::uint32_t THREADS = 256;

Pass light_spheres_pass(ResourceId spheres, const DeviceTraits& traits) {
  const std::uint32_t threads = std::min(THREADS, std::bit_floor(traits.max_group_invocations));
  return {.name = "light spheres",
          .shader = "methods/light_spheres",
          .constants = {threads},
          .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {spheres, Access::write}},
          .extent = {.lights_per_group = threads}};
}

void replace_input(std::vector<Binding>& bindings, ResourceId spheres) {
  for (Binding& binding : bindings)
    if (binding.resource == INPUT_SPHERES) binding.resource = spheres;
}

void replace_input(std::vector<Pass>& passes, LookUp& lookup, const Pass& maker, ResourceId spheres) {
  for (Pass& pass : passes) replace_input(pass.bindings, spheres);
  replace_input(lookup.bindings, spheres);
  // Host passes stay in front of every GPU pass.
  passes.insert(std::ranges::find_if(passes, [](const Pass& pass) { return pass.kind != PassKind::host; }), maker);
}

}  // namespace

void make_own_spheres(Plan& plan, const DeviceTraits& traits) {
  if (!plan.binds(INPUT_SPHERES)) return;
  const std::uint64_t lights = std::max(1U, plan.light_capacity);
  const ResourceId spheres = plan.add({.name = "light spheres", .bytes = lights * sizeof(shared::LightSphere)});
  const Pass maker = light_spheres_pass(spheres, traits);
  replace_input(plan.passes, plan.lookup, maker, spheres);
  if (plan.fused) replace_input(plan.fused->passes, plan.fused->lookup, maker, spheres);
}

}  // namespace lamp
