// Sums up lists of still lights.
// SPDX-License-Identifier: Apache-2.0
#include "commands/still_stats.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/stats.h"

namespace lamp::app {
StillStats still_stats(const StillSetup& still) {
  return {.lights = still.lists.lights,
          .triangles = still.lists.triangles,
          .bytes = still.lists.bytes(),
          .build_ms = still.build_ms,
          .lists = still.lists.stats,
          .notes = still.lists.notes};
}

void add_still_walks(Session& session, std::vector<std::uint32_t>& walked) {
  const std::vector<gpu::StillPoint> points = pixel_points(session.renderer(), session.gpu_scene(), session.shaders());
  for (std::size_t i = 0; i < walked.size(); ++i)
    if (points[i].triangle != NO_TRIANGLE)
      walked[i] +=
          static_cast<std::uint32_t>(lights_at(session.still()->lists, points[i].triangle, points[i].position).size());
}

std::string still_words(const StillStats& s) {
  return fmt::format(
      "{} lights in triangle lists: {:.2f} MB, {:.1f} bytes for each of {} triangles; {} patches, {} lists in {} "
      "groups, {:.1f} lights on average; left out {} hidden and {} behind; made in {:.0f} ms",
      s.lights, static_cast<double>(s.bytes) / 1e6,
      s.triangles == 0 ? 0.0 : static_cast<double>(s.bytes) / static_cast<double>(s.triangles), s.triangles,
      s.lists.patches, s.lists.lists, s.lists.groups,
      s.lists.patches == 0 ? 0.0 : static_cast<double>(s.lists.listed) / static_cast<double>(s.lists.patches),
      s.lists.hidden, s.lists.behind, s.build_ms);
}

nlohmann::json to_json(const StillStats& s) {
  nlohmann::json json{
      {"lights", s.lights},         {"triangles", s.triangles}, {"bytes", s.bytes},         {"build_ms", s.build_ms},
      {"patches", s.lists.patches}, {"tables", s.lists.tables}, {"groups", s.lists.groups}, {"lists", s.lists.lists},
      {"listed", s.lists.listed},   {"hidden", s.lists.hidden}, {"behind", s.lists.behind}, {"patch", s.lists.patch},
      {"merged", s.lists.merged},   {"notes", s.notes}};
  for (const auto& [kind, f] : s.findings) {
    nlohmann::json row{{"points", kind},
                       {"count", f.points},
                       {"missed", f.missed},
                       {"walked", f.walked},
                       {"reaching", f.reaching},
                       {"lighting", f.lighting},
                       {"boundary_pairs", f.boundary_pairs},
                       {"list_max", f.longest},
                       {"differing", f.differing},
                       {"verdict", name_of(f.verdict())}};
    add_number(row, "waste", waste_of(f.walked, f.reaching), NONE_USEFUL);
    add_number(row, "waste_of_lighting", waste_of(f.walked, f.lighting), NONE_USEFUL);
    json["checks"].push_back(std::move(row));
  }
  return json;
}

}  // namespace lamp::app
