// lamp verify: every method against the oracle and against brute force's picture.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "commands/commands.h"
#include "commands/stats.h"

namespace lamp::app {
namespace {

struct VerifyOptions {
  Request request;
  std::vector<std::string> methods;
  bool json = false;
};

/// A method under test: its look-ups, and what they were found to hold.
struct Candidate {
  Candidate(Lighting separate_lighting, std::uint32_t width)
      : lighting(std::move(separate_lighting)), separate(width), fused(width), decals(width), fused_decals(width) {}
  Lighting lighting;
  Verification separate;
  Verification fused;
  Verification decals;
  Verification fused_decals;
};

void progress(std::string_view text) {
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[K{}", text);
}

std::vector<const Method*> wanted_methods(const VerifyOptions& o) {
  std::vector<const Method*> wanted;
  for (const std::string& name : o.methods) wanted.push_back(&parse_method(name));
  if (wanted.empty())
    for (const Method& method : methods()) wanted.push_back(&method);
  if (wanted.size() != 1 && !o.request.options.empty())
    throw Error("--option: belongs to one method; name it with --method");
  for (const Method* method : wanted) check_request(o.request, *method);
  return wanted;
}

void visit_band(Session& session, const Truth& truth, std::vector<Candidate>& candidates) {
  using Passes = vulkan::PlanRunner::Passes;
  for (Candidate& candidate : candidates) {
    progress(fmt::format("verify rows {} .. {}: {}", truth.first_row, truth.first_row + truth.rows,
                         candidate.lighting.info().method->name));
    candidate.separate.add(truth, session.renderer().visit(candidate.lighting, truth));
    if (candidate.lighting.runner().plan().fused)
      candidate.fused.add(truth, session.renderer().visit(candidate.lighting, truth, Passes::fused));
  }
}

/// The same for the decals' range of ids.
void visit_decals(Session& session, const Truth& truth, std::vector<Candidate>& candidates) {
  using Passes = vulkan::PlanRunner::Passes;
  constexpr Renderer::Kind DECALS = Renderer::Kind::decals;
  for (Candidate& candidate : candidates) {
    progress(fmt::format("verify decals: {}", candidate.lighting.info().method->name));
    candidate.decals.add(truth, session.renderer().visit(candidate.lighting, truth, Passes::separate, DECALS));
    if (candidate.lighting.runner().plan().fused)
      candidate.fused_decals.add(truth, session.renderer().visit(candidate.lighting, truth, Passes::fused, DECALS));
  }
}

Findings decal_findings_of(Candidate& candidate) {
  Findings separate = candidate.decals.findings();
  if (!candidate.lighting.runner().plan().fused) return separate;
  return of_both(separate, candidate.fused_decals.findings());
}

Findings findings_of(Candidate& candidate) {
  Findings separate = candidate.separate.findings();
  if (!candidate.lighting.runner().plan().fused) return separate;
  return of_both(separate, candidate.fused.findings());
}

/// A row of the table.
struct Row {
  Stats stats;
  bool good = false;
};

void print_decals(const Stats& s) {
  const Findings& f = *s.decal_findings;
  fmt::print("  decals: {} missed, {} walked for {} that hold their pixel\n", f.missed, f.evaluations, f.useful);
  if (!f.first_miss.empty()) fmt::print("  first miss of a decal, by its id behind the lights: {}\n", f.first_miss);
}

void print_table(std::span<const Row> rows) {
  fmt::print("{:<24} {:>8} {:>14} {:>9} {:>9} {:>9} {:>9} {:>10} {:>11} {:>10}  {}\n", "method", "missed",
             "evaluations", "waste", "excess", "mean", "longest", "overflowed", "difference", "cull ms", "");
  for (const auto& [s, good] : rows) {
    const Findings& f = *s.findings;
    const std::uint64_t missed = f.missed + (s.decal_findings ? s.decal_findings->missed : 0);
    const char* verdict = !good ? "FAILED" : s.approximate && missed != 0 ? "approximate" : "ok";
    fmt::print("{:<24} {:>8} {:>14} {:>9.2f} {:>9.2f} {:>9.1f} {:>9} {:>10} {:>11.3g} {:>10.3f}  {}\n", s.method,
               f.missed, f.evaluations, f.waste(), f.excess(), f.list_mean(), f.list_max,
               s.rendered.counters.overflowed_cells, *s.image_max_abs_diff, s.rendered.cull_ms, verdict);
    for (const std::string& note : s.notes) fmt::print("  note: {}\n", note);
    if (!f.first_miss.empty()) fmt::print("  first miss: {}\n", f.first_miss);
    if (s.decal_findings) print_decals(s);
    if (s.ordered && f.unordered) fmt::print("  a list does not ascend\n");
    if (!s.approximate && !(*s.image_max_abs_diff <= *s.image_tolerance))
      fmt::print("  the picture may differ by {:.3g}\n", *s.image_tolerance);
  }
}

Stats render_candidate(const VerifyOptions& o, Session& session, const Setup& setup, Candidate& candidate,
                       const HdrImage& reference) {
  progress(fmt::format("verify picture: {}", candidate.lighting.info().method->name));
  Rendered rendered = session.renderer().render(candidate.lighting);
  float difference = max_abs_difference(rendered.image, reference);
  if (candidate.lighting.runner().plan().fused && candidate.lighting.info().path == ShadingPath::deferred) {
    Lighting fused =
        session.lighting(*candidate.lighting.info().method, o.request.options, ShadingPath::tiled_deferred);
    difference = std::max(difference, max_abs_difference(session.renderer().render(fused).image, reference));
  }
  Stats stats = make_stats(o.request, session, candidate.lighting, setup, std::move(rendered), 1);
  stats.image_max_abs_diff = difference;
  stats.image_tolerance = picture_tolerance(candidate.lighting.runner().plan(), reference);
  stats.findings = findings_of(candidate);
  if (!setup.decals.empty()) stats.decal_findings = decal_findings_of(candidate);
  stats.verified = true;
  return stats;
}

Exit verify(const VerifyOptions& o) {
  const ShadingPath path = parse_path(o.request.path);
  const std::vector<const Method*> wanted = wanted_methods(o);
  const Setup setup = make_setup(o.request);
  Session session(o.request, setup);
  Lighting brute = session.lighting(parse_method("all"), {}, path);
  progress("verify picture: brute force");
  const HdrImage reference = session.renderer().render(brute).image;
  const std::vector<float> depth = session.renderer().read_depth();

  std::vector<Candidate> candidates;
  for (const Method* method : wanted)
    candidates.emplace_back(session.lighting(*method, o.request.options, path), setup.view.width());
  for_each_truth(setup.view, depth, setup.lights, session.context().device().traits.max_storage_buffer_bytes,
                 [&](const Truth& truth) { visit_band(session, truth, candidates); });
  const std::vector<shared::OrientedBox> boxes = boxes_of(setup.decals);
  if (!boxes.empty())
    for_each_truth({.view = setup.view,
                    .depth = depth,
                    .lights = {},
                    .boxes = boxes,
                    .first_id = static_cast<std::uint32_t>(setup.lights.size())},
                   session.context().device().traits.max_storage_buffer_bytes,
                   [&](const Truth& truth) { visit_decals(session, truth, candidates); });

  std::vector<Row> rows;
  for (Candidate& candidate : candidates) {
    Stats stats = render_candidate(o, session, setup, candidate, reference);
    const Plan& plan = candidate.lighting.runner().plan();
    const PictureDifference difference{.max_abs = *stats.image_max_abs_diff, .tolerance = *stats.image_tolerance};
    const bool good = keeps_promises(plan, *stats.findings, difference) &&
                      (!stats.decal_findings || keeps_promises(plan, *stats.decal_findings, difference));
    rows.push_back({.stats = std::move(stats), .good = good});
  }
  progress("");
  if (o.json) {
    nlohmann::json array = nlohmann::json::array();
    for (const Row& row : rows) array.push_back(to_json(row.stats));
    fmt::print("{}\n", array.dump(2));
  } else {
    fmt::print("{} ({}), {} {}x{}, {} lights: {}\n", session.context().row().name, session.context().row().driver,
               o.request.scene, setup.view.width(), setup.view.height(), setup.lights.size(), setup.lights_note);
    print_table(rows);
  }
  return std::ranges::all_of(rows, &Row::good) ? Exit::done : Exit::check_failed;
}

}  // namespace

Run add_verify(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("verify", "Check methods against the oracle and brute force; exit 1 on a miss");
  auto o = std::make_shared<VerifyOptions>();
  o->request.size = "640x360";
  o->request.lights = 1024;
  add_common_options(*command, o->request);
  add_decal_option(*command, o->request);
  command->add_option("--method", o->methods, "method to check; may be given more than once; default: all of them")
      ->allow_extra_args(false);
  command->add_option("--option", o->request.options, "option of the one method, KEY=VALUE")->allow_extra_args(false);
  command->add_option("--path", o->request.path, "forward, tiled-deferred, deferred or standard-deferred")
      ->capture_default_str();
  command->add_flag("--json", o->json, "print an array of Stats objects, one a method");
  command->footer(
      "Examples:\n"
      "  lamp verify atrium --lights 8192\n"
      "  lamp verify atrium --decals 64\n"
      "  lamp verify blocks --method tiled --option tile=8 --projection orthographic");
  return [o] { return verify(*o); };
}

}  // namespace lamp::app
