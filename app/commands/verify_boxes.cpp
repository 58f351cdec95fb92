// Asks the oracle for one kind, and walks that kind's range.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_boxes.h"

#include <fmt/format.h>

#include "system/progress.h"

namespace lamp::app {

Findings BoxCheck::findings(const Lighting& lighting) const {
  const Findings found = separate.findings();
  return lighting.runner().plan().fused ? of_both(found, fused.findings()) : found;
}

void check_boxes_of(Renderer& renderer, const FrameBoxes& frame, std::span<const float> depth, Rows rows,
                    std::span<const std::pair<Lighting*, BoxCheck*>> checks) {
  using Passes = vulkan::PlanRunner::Passes;
  if (checks.empty()) return;
  const bool probes = checks.front().second->kind == Renderer::Kind::probes;
  const std::vector<shared::OrientedBox> boxes = probes ? boxes_of(frame.probes) : boxes_of(frame.decals);
  const EntityRange ids = probes ? renderer.entities().probes : renderer.entities().decals;
  if (boxes.empty()) return;
  const std::vector<EntityShape> shapes = probes ? shapes_of(frame.probes) : std::vector<EntityShape>();
  const View& view = renderer.view();
  for_each_truth(
      {.view = view,
       .depth = depth,
       .lights = {},
       .first_row = rows.first,
       .rows = rows.count,
       .boxes = boxes,
       .shapes = shapes,
       .first_id = ids.first},
      [&](const Truth& truth) {
        for (const auto& [lighting, check] : checks) {
          show_progress(fmt::format("verify {}: {}", probes ? "probes" : "decals", lighting->info().method->name));
          const FramePicture of = renderer.shown();
          check->separate.add(truth, renderer.visit(*lighting, truth, Passes::separate, check->kind), of);
          if (lighting->runner().plan().fused)
            check->fused.add(truth, renderer.visit(*lighting, truth, Passes::fused, check->kind), of);
        }
      });
}

}  // namespace lamp::app
