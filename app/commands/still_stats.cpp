// Sums up lists of still lights.
// SPDX-License-Identifier: Apache-2.0
#include "commands/still_stats.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/stats.h"
#include "render/still_tree.h"

namespace lamp::app {
StillStats still_stats(const StillSetup& still) {
  if (still.tree)
    return {.lights = still.tree->lights().size(),
            .triangles = still.triangles.size(),
            .bytes = still.words().size_bytes(),
            .build_ms = still.build_ms,
            .tree = still.tree->counts(),
            .notes = notes_of(still.tree->counts(), WorldTreeInfo().detail)};
  return {.lights = still.lists.lights,
          .triangles = still.lists.triangles,
          .bytes = still.lists.bytes(),
          .build_ms = still.build_ms,
          .lists = still.lists.stats,
          .notes = still.lists.notes};
}

std::string still_words(const StillStats& s) {
  if (s.tree)
    return fmt::format("{} lights in a world tree: {:.2f} MB; {} leaves with {} entries; made in {:.0f} ms", s.lights,
                       static_cast<double>(s.bytes) / 1e6, s.tree->leaves, s.tree->entries, s.build_ms);
  return fmt::format(
      "{} lights in triangle lists: {:.2f} MB, {:.1f} bytes for each of {} triangles; {} patches, {} lists in {} "
      "groups, {:.1f} lights on average; left out {} hidden and {} behind; made in {:.0f} ms",
      s.lights, static_cast<double>(s.bytes) / 1e6,
      s.triangles == 0 ? 0.0 : static_cast<double>(s.bytes) / static_cast<double>(s.triangles), s.triangles,
      s.lists.patches, s.lists.lists, s.lists.groups,
      s.lists.patches == 0 ? 0.0 : static_cast<double>(s.lists.listed) / static_cast<double>(s.lists.patches),
      s.lists.hidden, s.lists.behind, s.build_ms);
}

namespace {

nlohmann::json numbers_of(const StillStats& s) {
  if (s.tree)
    return {{"lights", s.lights},         {"triangles", s.triangles}, {"bytes", s.bytes},
            {"build_ms", s.build_ms},     {"leaves", s.tree->leaves}, {"entries", s.tree->entries},
            {"coarser", s.tree->coarser}, {"notes", s.notes}};
  return {
      {"lights", s.lights},         {"triangles", s.triangles}, {"bytes", s.bytes},         {"build_ms", s.build_ms},
      {"patches", s.lists.patches}, {"tables", s.lists.tables}, {"groups", s.lists.groups}, {"lists", s.lists.lists},
      {"listed", s.lists.listed},   {"hidden", s.lists.hidden}, {"behind", s.lists.behind}, {"patch", s.lists.patch},
      {"merged", s.lists.merged},   {"notes", s.notes}};
}

}  // namespace

nlohmann::json to_json(const StillStats& s) {
  nlohmann::json json = numbers_of(s);
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
