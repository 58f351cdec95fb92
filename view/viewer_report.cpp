// What is set and what is seen, as JSON: for scripts.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "view/mask_overlay.h"
#include "view/viewer.h"

namespace lamp::app {
namespace {

nlohmann::json report_of(const Legend& legend) {
  return {{"mean", legend.mean},       {"max", legend.max},         {"high", legend.high},      {"cells", legend.cells},
          {"reached", legend.reached}, {"lacking", legend.lacking}, {"refused", legend.refused}};
}

nlohmann::json report_of(const DepthBins& bins, const std::optional<Inspection>& picked) {
  std::uint32_t longest = 0;
  for (const BinRanks& ranks : bins.bins) longest = std::max(longest, ranks.length());
  nlohmann::json json{{"count", bins.bins.size()}, {"longest", longest}, {"lights", bins.lights}};
  const auto bin = picked ? bins.bin_at(picked->pixel) : std::nullopt;
  if (bin) json["picked"] = {{"bin", *bin}, {"length", bins.bins[*bin].length()}};
  return json;
}

nlohmann::json report_of(const ShownWorld& world) {
  nlohmann::json json{{"refused", world.refused},
                      {"method", world.method},
                      {"cells", world.cells.size()},
                      {"longest", world.longest},
                      {"points", nlohmann::json::array()}};
  for (const PointList& point : world.points)
    json["points"].push_back(
        {{"what", point.what}, {"walked", point.walked}, {"reaching", point.reaching}, {"missed", point.missed}});
  return json;
}

}  // namespace

nlohmann::json Viewer::report() const {
  nlohmann::json json = to_json(state_);
  json["error"] = error_;
  json["said"] = said_;
  json["pictures"] = shown_.number;
  json["picture_ms"] = picture_ms_;
  if (!times_.interface_row().ms.empty()) json["interface_ms"] = times_.interface_row().at(0.5);
  json["bookmarks"] = bookmarks_.size();
  if (shown_.number != 0) json["shown"] = to_json(shown_.first.stats);
  if (shown_.second) json["shown_b"] = to_json(shown_.second->stats);
  if (!proof_.empty()) json["proof"] = proof_;
  if (shown_.picture_difference) json["picture_difference"] = *shown_.picture_difference;
  const Overlay laid_over = shown_.first.legend.refused.empty() ? shown_.first.legend.overlay : Overlay::none;
  if (laid_over == Overlay::difference) json["differing_pixels"] = shown_.first.legend.cells;
  if (laid_over == Overlay::shadow_atlas) json["atlas_side_shown"] = shown_.first.legend.max;
  if (!shown_.first.lengths.empty()) json["longest_lists"] = shown_.first.lengths.back().high;
  json["decals_shown"] = shown_.decals.size();
  if (laid_over == Overlay::missed) json["missing_pixels"] = shown_.first.legend.cells;
  for (const OtherList& list : others_)
    json["others"][list.method] = {{"lights", list.lights.size()},
                                   {"reaching", list.reaching},
                                   {"beyond", list.beyond.size()},
                                   {"without", list.without.size()},
                                   {"refused", list.refused}};
  json["outdated"] = outdated_;
  json["list_row_in_sight"] = list_scroll_.in_sight;
  if (shown_.first.legend.overlay != Overlay::none) {
    json["legend"] = report_of(shown_.first.legend);
    json["legend"]["numbers"] = numbers_;
    if (shown_.second) json["legend_b"] = report_of(shown_.second->legend);
  }
  if (shown_.number != 0) json["keeps_masks"] = shown_.first.keeps_masks;
  if (shown_.proxies)
    json["proxies_shown"] = {{"drawn", shown_.proxies->drawn},
                             {"cut", shown_.proxies->cut},
                             {"inside", shown_.proxies->inside},
                             {"shapes", shown_.proxies->shapes.size()},
                             {"refused", shown_.proxies->refused}};
  if (shown_.shadow)
    json["shadow_of_light"] = {{"squares", shown_.shadow->squares.size()},
                               {"side", shown_.shadow->map.side},
                               {"age", shown_.shadow->age},
                               {"corners", shown_.shadow->shape.corners.size()}};
  json["probes_shown"] = shown_.probe_volumes.size();
  if (shown_.world) json["world"] = report_of(*shown_.world);
  if (shown_.bins) json["bins"] = report_of(*shown_.bins, shown_.inspection);
  if (!shown_.inspection) return json;
  const Inspection& found = *shown_.inspection;
  // A test that drops a light which reaches the cell would lose it.
  const auto lost = std::ranges::count_if(found.lights, [](const ListedLight& light) {
    return (light.reaches_cell || light.reach == Reach::inside) && light.passes != gpu::PASSES_ALL;
  });
  nlohmann::json own = nlohmann::json::array();
  for (std::size_t i = 0; i < test_names().size(); ++i)
    if ((found.own.passes >> i & 1U) != 0) own.push_back(test_names()[i]);
  const auto larger = std::ranges::count_if(found.lights, [&](const ListedLight& light) {
    return why_listed(light, found.tests_of(light)).starts_with("larger cell");
  });
  json["inspection"] = {{"pixel", {found.pixel.x, found.pixel.y}},
                        {"method", shown_.inspected_side().stats.method},
                        {"sky", found.sky},
                        {"cell", found.cell},
                        {"lights", found.lights.size()},
                        {"lost_by_tests", lost},
                        {"own_tests", own},
                        {"of_larger_cells", larger},
                        {"still_lights", std::ranges::count(found.lights, true, &ListedLight::still)},
                        {"missed", found.proof.missed},
                        {"pairs", found.proof.pairs},
                        {"occupied_parts", std::popcount(found.mask.mask)},
                        {"empty_m", empty_m(found.mask)}};
  if (found.looked_at)
    json["inspection"]["looked_at"] = {{"listed", found.looked_at->listed},
                                       {"parts", std::popcount(found.looked_at->parts)},
                                       {"words", words_of_parts(found)}};
  for (const ListedProbe& probe : found.probes)
    json["inspection"]["probes"].push_back({{"slot", probe.slot}, {"weight", probe.weight}, {"share", probe.share}});
  return json;
}

}  // namespace lamp::app
