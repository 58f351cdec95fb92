// Stats to JSON.
// SPDX-License-Identifier: Apache-2.0
#include "commands/stats.h"

namespace lamp::app {

Stats make_stats(const StatsInfo& info, Lighting& lighting, Rendered rendered) {
  const Plan& plan = lighting.runner().plan();
  Stats stats{.device = info.device.name,
              .driver = info.device.driver,
              .scene = info.scene,
              .method = std::string(lighting.info().method->name),
              .options = lighting.info().options,
              .path = std::string(path_names()[static_cast<std::size_t>(lighting.info().path)]),
              .width = info.view.width(),
              .height = info.view.height(),
              .lights = info.lights,
              .decals = info.decals,
              .frames = info.frames,
              .rendered = std::move(rendered),
              .cells = plan.cells,
              .notes = plan.notes,
              .ordered = plan.ordered,
              .approximate = plan.approximate};
  stats.rendered.image.pixels = {};
  for (const BufferDesc& buffer : plan.buffers) stats.bytes.emplace_back(buffer.name, buffer.bytes);
  stats.bytes.emplace_back("total", plan.bytes());
  return stats;
}

Stats make_stats(const Request& request, Session& session, Lighting& lighting, const Setup& setup, Rendered rendered,
                 std::uint32_t frames) {
  return make_stats({.device = session.context().row(),
                     .scene = request.scene,
                     .view = setup.view,
                     .lights = setup.lights.size(),
                     .frames = frames,
                     .decals = setup.decals.size()},
                    lighting, std::move(rendered));
}

nlohmann::json to_json(const Stats& s) {
  nlohmann::json json{{"device", s.device},
                      {"driver", s.driver},
                      {"scene", s.scene},
                      {"method", s.method},
                      {"options", nlohmann::json::object()},
                      {"path", s.path},
                      {"width", s.width},
                      {"height", s.height},
                      {"lights", s.lights},
                      {"decals", s.decals},
                      {"frames", s.frames},
                      {"passes", nlohmann::json::array()},
                      {"cull_ms", s.rendered.cull_ms},
                      {"shade_ms", s.rendered.shade_ms},
                      {"frame_ms", s.rendered.frame_ms},
                      {"bytes", nlohmann::json::object()},
                      {"cells", s.cells},
                      {"notes", s.notes},
                      {"overflowed_cells", s.rendered.counters.overflowed_cells}};
  for (const auto& [key, value] : s.options.all()) json["options"][key] = value;
  for (const PassTime& pass : s.rendered.passes)
    json["passes"].push_back({{"name", pass.name},
                              {"part", pass.cull    ? "cull"
                                       : pass.shade ? "shade"
                                                    : "other"},
                              {"ms_median", pass.ms_median},
                              {"ms_p5", pass.ms_p5},
                              {"ms_p95", pass.ms_p95}});
  for (const auto& [name, bytes] : s.bytes) json["bytes"][name] = bytes;
  if (s.findings) {
    const Findings& f = *s.findings;
    json["evaluations"] = f.evaluations;
    json["list_mean"] = f.list_mean();
    json["list_max"] = f.list_max;
    if (s.verified)
      json.update({{"missed", f.missed}, {"useful", f.useful}, {"waste", f.waste()}, {"excess", f.excess()}});
    if (f.missed_fused) json["missed_fused"] = *f.missed_fused;
  }
  if (s.decal_findings)
    json.update({{"decals_missed", s.decal_findings->missed},
                 {"decal_evaluations", s.decal_findings->evaluations},
                 {"decals_useful", s.decal_findings->useful}});
  if (s.image_max_abs_diff) json["image_max_abs_diff"] = *s.image_max_abs_diff;
  if (s.image_tolerance) json["image_tolerance"] = *s.image_tolerance;
  return json;
}

}  // namespace lamp::app
