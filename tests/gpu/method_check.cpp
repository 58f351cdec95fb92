// Runs methods and compares.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/method_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <utility>

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

/// The lightings used last, latest first. A driver in software keeps tens of megabytes of code for each.
constexpr std::size_t KEPT = 24;
std::list<std::pair<std::string, Lighting>> kept;

LightingInfo info_of(const Renderer& renderer, const Candidate& candidate, ShadingPath path) {
  return {.method = candidate.method,
          .options = take(resolve_options(*candidate.method, candidate.settings)),
          .width = renderer.targets().width,
          .height = renderer.targets().height,
          .light_capacity = candidate.light_capacity,
          .path = path};
}

Findings find(Renderer& renderer, Lighting& lighting, const LitCase& lit, Passes which) {
  const std::vector<Visit> visits = renderer.visit(lighting, lit.truth, which);
  const Plan& plan = lighting.runner().plan();
  const std::uint64_t cells = plan.binds(INPUT_STILL) ? ~0U : plan.cells;  // what is made ahead has cells of its own
  for (const Visit& visit : visits)
    if (visit.cell != ~0U && visit.cell >= cells) {
      ADD_FAILURE() << "cell " << visit.cell << " of " << cells;
      break;
    }
  Verification verification(lit.view.width());
  verification.add(lit.truth, visits);
  return verification.findings();
}

void check_findings(const Findings& findings, const LitCase& lit, const Plan& plan) {
  if (!plan.approximate) {
    EXPECT_EQ(findings.missed, 0) << findings.first_miss;
    EXPECT_GE(findings.evaluations, findings.useful);
  }
  EXPECT_FALSE(plan.ordered && findings.unordered);
  EXPECT_LE(findings.list_max, lit.lights.size());
  EXPECT_EQ(findings.useful, lit.truth.lights.size());
}

/// Returns how many cells did not fit.
std::uint32_t check_picture(Renderer& renderer, Lighting& lighting, const LitCase& lit) {
  const Rendered rendered = renderer.relight(lighting);
  const Plan& plan = lighting.runner().plan();
  if (!plan.approximate) {
    EXPECT_LE(max_abs_difference(rendered.image, lit.reference), picture_tolerance(plan, lit.reference));
  }
  return rendered.counters.overflowed_cells;
}

void check_fused_picture(Renderer& renderer, const LitCase& lit, const Candidate& candidate, std::uint32_t overflowed) {
  Lighting& fused = kept_lighting(renderer, candidate, ShadingPath::tiled_deferred);
  const std::uint32_t fused_overflowed = check_picture(renderer, fused, lit);
  // Shared memory has each tile's own list; one that all tiles share can run out before.
  if (fused.runner().plan().capacities.size() == 1) {
    EXPECT_EQ(fused_overflowed, overflowed);
  }
  EXPECT_LE(fused_overflowed, overflowed);
}

}  // namespace

const Method& brute_force() { return *take(find_method("all")); }

LitCase make_case(Renderer& renderer, const View& view, std::vector<shared::Light> lights) {
  LitCase lit{.view = view, .lights = std::move(lights)};
  Lighting& lighting = kept_lighting(renderer, {.method = &brute_force()}, ShadingPath::deferred);
  renderer.set_frame(view, lit.lights);
  lit.reference = renderer.render(lighting).image;
  lit.depth = renderer.read_depth();
  lit.truth = truth({.view = view, .depth = lit.depth, .lights = lit.lights, .rows = view.height()});
  return lit;
}

Lighting make_lighting(const Renderer& renderer, const Candidate& candidate, ShadingPath path) {
  vulkan::Device device = renderer.device();
  if (candidate.subgroup_size != 0) device.traits.subgroup_size = candidate.subgroup_size;
  return {device, shader_library(), info_of(renderer, candidate, path)};
}

Lighting& kept_lighting(const Renderer& renderer, const Candidate& candidate, ShadingPath path) {
  if (kept.empty()) at_context_end([] { kept.clear(); });
  // Brute force has no buffers of its own, so one lighting does for any number of lights that tests have.
  constexpr std::uint32_t MANY = 60'000;  // llvmpipe walks few more
  const std::uint32_t capacity = candidate.method == &brute_force() ? MANY : candidate.light_capacity;
  const std::string key = fmt::format(
      "{} {} {}x{} {} {} {}", candidate.method->name, fmt::join(candidate.settings, " "), renderer.targets().width,
      renderer.targets().height, capacity, candidate.subgroup_size, static_cast<int>(path));
  const auto found = std::ranges::find(kept, key, &std::pair<std::string, Lighting>::first);
  if (found != kept.end()) {
    kept.splice(kept.begin(), kept, found);
    return kept.front().second;
  }
  Candidate kept_candidate = candidate;
  kept_candidate.light_capacity = capacity;
  kept.emplace_front(key, make_lighting(renderer, kept_candidate, path));
  if (kept.size() > KEPT) kept.pop_back();
  return kept.front().second;
}

Findings check_method(Renderer& renderer, const LitCase& lit, const Candidate& candidate, Check check) {
  renderer.set_frame(lit.view, lit.lights);
  Lighting& lighting = kept_lighting(renderer, candidate, ShadingPath::deferred);
  const bool lists_alone = check == Check::lists;
  // Either draws the depth that visits read, too.
  const std::uint32_t overflowed =
      lists_alone ? renderer.cull(lighting).counters.overflowed_cells : check_picture(renderer, lighting, lit);
  const Findings findings = find(renderer, lighting, lit, Passes::separate);
  check_findings(findings, lit, lighting.runner().plan());
  if (check == Check::separate || !lighting.runner().plan().fused) return findings;

  SCOPED_TRACE("fused");
  if (!lists_alone) check_fused_picture(renderer, lit, candidate, overflowed);
  const Findings fused_findings = find(renderer, lighting, lit, Passes::fused);
  check_findings(fused_findings, lit, lighting.runner().plan());
  if (overflowed == 0) {
    EXPECT_EQ(fused_findings.evaluations, findings.evaluations);
  }
  return findings;
}

}  // namespace lamp::app
