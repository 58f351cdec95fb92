// Boxes as lines.
// SPDX-License-Identifier: Apache-2.0
#include "view/world_boxes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "render/heatmap_legend.h"
#include "view/light_marks.h"
#include "view/picture_lines.h"
#include "view/widgets.h"

namespace lamp::app {
namespace {

bool holds(const WorldCell& cell, const glm::vec3& point) {
  return glm::all(glm::greaterThanEqual(point, cell.low)) && glm::all(glm::lessThan(point, cell.low + cell.side));
}

}  // namespace

void draw_world_cells(const Shown& shown, const ScreenRect& picture) {
  if (!shown.world || shown.world->cells.empty()) return;
  const PictureLines lines(shown.view, picture);
  const glm::vec3 point = shown.world->points.front().position;
  for (const WorldCell& cell : shown.world->cells) {
    if (cell.lights == 0) continue;
    const glm::u8vec3 color =
        palette_color(shown.state.palette, heat_position(cell.lights, std::max(2U, shown.world->longest)));
    // Slightly smaller, so that neighbours' edges do not hide each other; the point's own stands out.
    const ImU32 ink = holds(cell, point) ? IM_COL32_WHITE : IM_COL32(color.r, color.g, color.b, 150);
    lines.box(cell.low + 0.5F * cell.side, glm::mat3(0.48F * cell.side), {.color = ink});
  }
}

void draw_probe_boxes(const Shown& shown, const ScreenRect& picture) {
  if (!shown.state.probe_boxes) return;
  const PictureLines lines(shown.view, picture);
  for (std::uint32_t i = 0; i < shown.probe_volumes.size(); ++i) {
    const shared::OrientedBox& box = shown.probe_volumes[i];
    const auto listed = [&](const ListedProbe& probe) { return probe.probe == i && probe.share > 0.0F; };
    const bool weighs = shown.inspection && std::ranges::any_of(shown.inspection->probes, listed);
    lines.box(box.center, axes_of(box), {.color = weighs ? IM_COL32(255, 220, 60, 255) : IM_COL32(150, 150, 255, 140)});
  }
}

void world_of_point(const Shown& shown) {
  if (!shown.world) return;
  const ShownWorld& world = *shown.world;
  for (const PointList& point : world.points) {
    const std::string waste =
        point.reaching == 0
            ? ""
            : fmt::format(", waste {:.2f}", static_cast<double>(point.walked) / static_cast<double>(point.reaching));
    Widgets::row(point.what == "mirrored" ? "its ray meets" : "in the world",
                 fmt::format("({:.2f}, {:.2f}, {:.2f}) m: {} listed by {}, {} reach, {} missed{}{}", point.position.x,
                             point.position.y, point.position.z, point.walked, world.method, point.reaching,
                             point.missed, waste, point.ended ? "; the device ended the walk" : ""));
  }
  if (!world.refused.empty()) return Widgets::note(world.refused);
  if (world.cells.empty()) Widgets::note("No light is in any cell: there are none to draw.");
}

void probes_of_pixel(const Shown& shown) {
  if (shown.probe_volumes.empty()) return;
  const Inspection& found = *shown.inspection;
  float rest = 1.0F - found.mirrored;
  if (found.mirrored > 0.0F)
    Widgets::row("mirrored ray", fmt::format("{:.1f}% of the reflection", 100.0 * found.mirrored));
  for (const ListedProbe& probe : found.probes) {
    rest -= probe.share;
    Widgets::row(fmt::format("probe {}", probe.slot),
                 fmt::format("{:.1f}% of the reflection; weight {:.3f}, {:.3f} by its volume alone",
                             100.0 * probe.share, probe.weight, probe.volume));
  }
  Widgets::row("surroundings", fmt::format("{:.1f}% of the reflection", 100.0 * rest));
}

}  // namespace lamp::app
