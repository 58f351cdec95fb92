// What a frame's shadows came to, as JSON and in words.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/stats.h"

namespace lamp::app {

std::optional<ShadowStats> shadow_stats(const Shadows* shadows) {
  if (shadows == nullptr) return std::nullopt;
  const auto lights_of = [&](std::span<const std::uint32_t> records) {
    std::vector<std::uint32_t> lights;
    for (const std::uint32_t record : records) lights.push_back(shadows->light_of(record));
    return lights;
  };
  return ShadowStats{.settings = shadows->settings(),
                     .counts = shadows->counts(),
                     .waiting = lights_of(shadows->waiting()),
                     .without = lights_of(shadows->without())};
}

std::string shadow_words(const ShadowStats& shadows) {
  const ShadowCounts& c = shadows.counts;
  std::string words = fmt::format("{}: {} of {} lights in view have one", shadow_filter_name(shadows.settings.filter),
                                  c.shadowed, c.seen);
  if (c.no_room != 0) words += fmt::format(", {} fit nowhere", c.no_room);
  if (c.waiting != 0) words += fmt::format(", {} wait to be drawn", c.waiting);
  if (c.smaller != 0) words += fmt::format(", {} are smaller than asked for", c.smaller);
  return words +
         fmt::format("; {} texels of {} x {}", c.used_texels, shadows.settings.atlas_size, shadows.settings.atlas_size);
}

std::string truth_words(const ShadowFindings& truth) {
  const auto percent = [](const ShadowLight& light) {
    return fmt::format("leaks {:.2f} %, false shadows {:.2f} %", 100.0 * light.leaks(), 100.0 * light.false_shadows());
  };
  std::string words = percent(truth.all) + " (of the light that rays stop, and that arrives)";
  if (truth.all.bled > 0.0) words += fmt::format(", {:.2f} % bleeding", 100.0 * truth.all.bleeding());
  words += fmt::format("; {} px from edges and more: {}", EDGE_PX, percent(truth.away));
  words += fmt::format("; beyond the filter's reach, where {:.0f} % of the stopped light is: {}",
                       100.0 * truth.stopped_beyond(), percent(truth.beyond));
  return words + fmt::format(" ({} pairs{}, {} unclear)", truth.pairs,
                             truth.thinned > 1 ? fmt::format(", one of {}", truth.thinned) : "", truth.unclear);
}

std::string cut_words(const ShadowFindings& truth) {
  std::string words =
      fmt::format("{} of {} pairs that maps leave dark are beyond the light's radial bound, and {} that they light",
                  truth.cut, truth.dark, truth.lost);
  words += fmt::format("; of those whose light is behind the surface, {} of {}", truth.cut_behind, truth.behind);
  if (truth.has_meshes)
    words += fmt::format("; {} and {} are outside the light's mesh", truth.outside, truth.lost_outside);
  return words;
}

nlohmann::json to_json(const ShadowStats& shadows) {
  const ShadowCounts& c = shadows.counts;
  nlohmann::json json{{"filter", shadow_filter_name(shadows.settings.filter)},
                      {"points", shadows.settings.points == PointShadows::faces ? "faces" : "octahedron"},
                      {"atlas", shadows.settings.atlas_size},
                      {"seen", c.seen},
                      {"shadowed", c.shadowed},
                      {"without", c.without},
                      {"without_lights", shadows.without},
                      {"no_room", c.no_room},
                      {"waiting", c.waiting},
                      {"waiting_lights", shadows.waiting},
                      {"smaller", c.smaller},
                      {"redrawn", c.redrawn},
                      {"redrawn_texels", c.redrawn_texels},
                      {"moved", c.moved},
                      {"evicted", c.evicted},
                      {"used_texels", c.used_texels}};
  if (const auto& truth = shadows.truth)
    json["truth"] = {{"pairs", truth->pairs},
                     {"thinned", truth->thinned},
                     {"unclear", truth->unclear},
                     {"in_shadow", truth->in_shadow},
                     {"dark", truth->dark},
                     {"cut", truth->cut},
                     {"lost", truth->lost},
                     {"behind", truth->behind},
                     {"cut_behind", truth->cut_behind},
                     {"outside", truth->outside},
                     {"lost_outside", truth->lost_outside},
                     {"verdict", name_of(truth->is_right() ? Verdict::ok : Verdict::failed)},
                     {"leaks", truth->all.leaks()},
                     {"false_shadows", truth->all.false_shadows()},
                     {"bleeding", truth->all.bleeding()},
                     {"leaks_away", truth->away.leaks()},
                     {"false_shadows_away", truth->away.false_shadows()},
                     {"stopped_beyond", truth->stopped_beyond()},
                     {"leaks_beyond", truth->beyond.leaks()},
                     {"false_shadows_beyond", truth->beyond.false_shadows()}};
  if (const auto& leaks = shadows.leaks)
    json["picture"] = {{"leaks", leaks->light.leaks()},
                       {"false_shadows", leaks->light.false_shadows()},
                       {"unclear", leaks->unclear},
                       {"ended", leaks->ended}};
  return json;
}

}  // namespace lamp::app
