// Inputs of a plan's own: a buffer, a pass, and every binding of the input turned to the buffer.
// SPDX-License-Identifier: Apache-2.0
#include "own_inputs.h"

#include <algorithm>
#include <bit>
#include <string>

namespace lamp {
namespace {

constexpr std::uint32_t THREADS = 256;
constexpr std::uint32_t UNIT = 16;  ///< bytes that host_lights.glsl counts in

/// An input, and who makes what takes its place.
struct Maker {
  ResourceId input = NO_RESOURCE;
  ResourceId own = NO_RESOURCE;
  Pass pass;
};

/// Reads lights as the host keeps them; constants and bindings of host_lights.glsl, unless they are standard.
Maker make_maker(Plan& plan, const Problem& problem, ResourceId input, std::string name, std::uint64_t light_bytes) {
  const LightLayout& layout = problem.light_layout;
  const std::uint64_t lights = std::max(1U, plan.light_capacity);
  const std::uint32_t threads = std::min(THREADS, std::bit_floor(problem.traits.max_group_invocations));
  const ResourceId own = plan.add({.name = name, .bytes = lights * light_bytes, .all_views = true});
  Pass pass{.name = std::move(name),
            .constants = {threads},
            .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {own, Access::write}},
            .extent = {.lights_per_group = threads},
            .once = true};
  if (!layout.is_standard()) {
    pass.constants.insert(pass.constants.end(),
                          {static_cast<std::uint32_t>(layout.form), layout.lights.offset / UNIT,
                           layout.light_stride() / UNIT, layout.cones.offset / UNIT, layout.cone_stride() / UNIT});
    pass.bindings.push_back({layout.form == LightForm::spots ? INPUT_CONES : INPUT_LIGHTS});
  }
  return {input, own, std::move(pass)};
}

Maker sphere_maker(Plan& plan, const Problem& problem) {
  Maker maker = make_maker(plan, problem, INPUT_SPHERES, "light spheres", sizeof(shared::LightSphere));
  maker.pass.shader = problem.light_layout.is_standard() ? "methods/light_spheres" : "methods/host_light_spheres";
  return maker;
}

Maker record_maker(Plan& plan, const Problem& problem) {
  Maker maker = make_maker(plan, problem, INPUT_LIGHTS, "light records", sizeof(shared::Light));
  maker.pass.shader = "methods/host_light_records";
  return maker;
}

void replace_inputs(std::vector<Binding>& bindings, const std::vector<Maker>& makers) {
  for (Binding& binding : bindings)
    for (const Maker& maker : makers)
      if (binding.resource == maker.input) binding.resource = maker.own;
}

void replace_inputs(std::vector<Pass>& passes, LookUp& lookup, const std::vector<Maker>& makers) {
  for (Pass& pass : passes) replace_inputs(pass.bindings, makers);
  replace_inputs(lookup.bindings, makers);
  // Host passes stay in front of every GPU pass.
  auto at = std::ranges::find_if(passes, [](const Pass& pass) { return pass.kind != PassKind::host; });
  for (const Maker& maker : makers) at = std::next(passes.insert(at, maker.pass));
}

}  // namespace

void make_own_inputs(Plan& plan, const Problem& problem) {
  std::vector<Maker> makers;
  if (problem.own_spheres && plan.binds(INPUT_SPHERES)) makers.push_back(sphere_maker(plan, problem));
  if (!problem.light_layout.is_standard() && plan.binds(INPUT_LIGHTS)) makers.push_back(record_maker(plan, problem));
  replace_inputs(plan.passes, plan.lookup, makers);
  if (plan.fused) replace_inputs(plan.fused->passes, plan.fused->lookup, makers);
}

}  // namespace lamp
