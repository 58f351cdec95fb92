// lamp verify: every method against the oracle and against brute force's picture.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "commands/auto_method.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/miss_map.h"
#include "commands/pictures.h"
#include "commands/verify_boxes.h"
#include "commands/verify_mirror.h"
#include "commands/verify_points.h"
#include "commands/verify_rows.h"
#include "commands/verify_shadows.h"
#include "commands/verify_still.h"
#include "files/utf8_path.h"
#include "render/antialias.h"
#include "render/gpu_verifier.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

struct VerifyOptions {
  Request request{.probes_show = "flat"};  // lists are checked; captures would take their time
  std::vector<std::string> methods;
  std::string out;  ///< picture of where lights are missed, or empty
  std::string verifier = "auto";
  std::uint32_t runs = 1;
  PointsRequest at_points;  ///< but its methods
  bool json = false;
};

/// A method under test, and what its look-ups were found to hold.
struct Candidate {
  Candidate(Lighting separate_lighting, std::vector<std::string> settings, std::uint32_t width)
      : options(std::move(settings)),
        lighting(std::move(separate_lighting)),
        separate(width, lighting.info().depth),
        fused(width, lighting.info().depth),
        decals(Renderer::Kind::decals, width, lighting.info().depth),
        probes(Renderer::Kind::probes, width, lighting.info().depth) {}
  std::vector<std::string> options;
  Lighting lighting;
  Verification separate;
  Verification fused;
  BoxCheck decals;
  BoxCheck probes;
  Findings findings;
  std::vector<PixelMisses> misses;
};

/// What its look-ups missed, of lights, decals and probes.
void collect_misses(Candidate& candidate) {
  for (const Verification* found : {&candidate.separate, &candidate.fused, &candidate.decals.separate,
                                    &candidate.decals.fused, &candidate.probes.separate, &candidate.probes.fused})
    candidate.misses.insert(candidate.misses.end(), found->misses().begin(), found->misses().end());
}

std::vector<std::string> wanted_methods(const VerifyOptions& o) {
  check_once("--method", o.methods);
  std::vector<std::string> wanted = o.methods;
  if (wanted.empty())
    for (const Method& method : methods()) wanted.emplace_back(method.name);
  check_one_method(wanted.size(), o.request.options);
  for (const std::string& method : wanted) check_request(o.request, method);
  return wanted;
}

/// Lights that are cut by what their maps hold need not be where these leave no light.
void visit_band(Session& session, const Truth& all, std::vector<Candidate>& candidates) {
  using Passes = vulkan::PlanRunner::Passes;
  std::optional<Truth> lit;
  for (Candidate& candidate : candidates) {
    const bool cut = is_cut(session, candidate.lighting);
    if (cut && !lit) lit = lit_truth(session.renderer(), session.shaders(), all);
    const Truth& truth = cut ? *lit : all;
    show_progress(fmt::format("verify rows {} .. {}: {}", truth.first_row, truth.first_row + truth.rows,
                              candidate.lighting.info().method->name));
    const FramePicture of = session.renderer().shown();
    candidate.separate.add(truth, session.renderer().visit(candidate.lighting, truth), of);
    if (candidate.lighting.runner().plan().fused)
      candidate.fused.add(truth, session.renderer().visit(candidate.lighting, truth, Passes::fused), of);
  }
}

void find_by_oracle(Session& session, const Setup& setup, std::vector<Candidate>& candidates) {
  for_each_picture(session.renderer(), [&](std::span<const float> depth) {
    const View& view = session.renderer().view();
    for_each_truth({.view = view, .depth = depth, .lights = setup.listed(), .rows = view.height()},
                   [&](const Truth& truth) { visit_band(session, truth, candidates); });
  });
  for (Candidate& candidate : candidates) {
    candidate.findings = candidate.separate.findings();
    if (candidate.lighting.runner().plan().fused)
      candidate.findings = of_both(candidate.findings, candidate.fused.findings());
  }
}

void find_by_gpu(Session& session, const Setup& setup, std::vector<Candidate>& candidates) {
  using Passes = vulkan::PlanRunner::Passes;
  show_progress("verify: every light at every pixel");
  GpuVerifier verifier(session.renderer(), setup.listed());
  for (Candidate& candidate : candidates) {
    show_progress(fmt::format("verify: {}", candidate.lighting.info().method->name));
    std::vector<PixelMisses>& misses = candidate.misses;
    candidate.findings = verifier.check(candidate.lighting, Passes::separate, &misses);
    if (candidate.lighting.runner().plan().fused)
      candidate.findings = of_both(candidate.findings, verifier.check(candidate.lighting, Passes::fused, &misses));
  }
}

/// The same for decals and probes.
void find_boxes(Session& session, const Setup& setup, std::vector<Candidate>& candidates) {
  if (setup.boxes() == 0) return;
  for_each_picture(session.renderer(), [&](std::span<const float> depth) {
    for (BoxCheck Candidate::* const kind : {&Candidate::decals, &Candidate::probes}) {
      std::vector<std::pair<Lighting*, BoxCheck*>> checks;
      for (Candidate& candidate : candidates) checks.emplace_back(&candidate.lighting, &(candidate.*kind));
      check_boxes_of(session.renderer(), {setup.decals, setup.probes}, depth, {0, setup.view.height()}, checks);
    }
  });
}

/// Makes lists again and again, and counts how often they are not the first's.
std::uint32_t changed_runs(Session& session, Candidate& candidate, std::uint32_t runs) {
  const std::vector<Visit> first = visit_all(session, candidate.lighting);
  std::uint32_t changed = 0;
  for (std::uint32_t run = 1; run < runs; ++run) {
    show_progress(fmt::format("verify run {} of {}: {}", run + 1, runs, candidate.lighting.info().method->name));
    if (!same_lists(visit_all(session, candidate.lighting), first)) ++changed;
  }
  return changed;
}

float picture_difference(Session& session, const Setup& setup, Candidate& candidate, const HdrImage& picture,
                         const HdrImage& reference) {
  float difference = max_abs_difference(picture, reference);
  if (candidate.lighting.runner().plan().fused && candidate.lighting.info().path == ShadingPath::deferred) {
    Lighting fused =
        session.lighting(*candidate.lighting.info().method, candidate.options, ShadingPath::tiled_deferred);
    const Rendered lit = setup.views.size() == 1
                             ? session.renderer().relight(fused)
                             : render_views(session.renderer(), fused, setup.lights, setup.decals, {});
    difference = std::max(difference, max_abs_difference(lit.image, reference));
  }
  return difference;
}

/// Without a reference, pictures are not compared.
Stats make_row(const VerifyOptions& o, Session& session, const Setup& setup, Candidate& candidate,
               const std::optional<HdrImage>& reference) {
  if (o.runs > 1) candidate.findings.changed_runs = changed_runs(session, candidate, o.runs);
  show_progress(fmt::format("verify picture: {}", candidate.lighting.info().method->name));
  session.renderer().wake(candidate.lighting);
  Rendered rendered = render_views(session.renderer(), candidate.lighting, setup.lights, setup.decals, {});
  const Plan& plan = candidate.lighting.runner().plan();
  std::optional<PictureDifference> difference;
  if (reference)
    difference = {.max_abs = picture_difference(session, setup, candidate, rendered.image, *reference),
                  .tolerance = picture_tolerance(plan, *reference)};
  Stats row = make_stats(o.request, session, candidate.lighting, setup, std::move(rendered), 1);
  row.judgement = judge(plan, candidate.findings, difference);
  if (!setup.decals.empty()) {
    row.decal_findings = candidate.decals.findings(candidate.lighting);
    row.judgement = worse_of(*row.judgement, judge(plan, *row.decal_findings, std::nullopt, "decal"));
  }
  if (!setup.probes.empty()) {
    row.probe_findings = candidate.probes.findings(candidate.lighting);
    row.judgement = worse_of(*row.judgement, judge(plan, *row.probe_findings, std::nullopt, "probe"));
  }
  if (difference) {
    row.image_max_abs_diff = difference->max_abs;
    row.image_tolerance = difference->tolerance;
  }
  row.findings = candidate.findings;
  return row;
}

/// Those that this device can run. Others get a row, or an error if they were named.
std::vector<Candidate> make_candidates(const VerifyOptions& o, Session& session, const Setup& setup,
                                       std::span<const std::string> wanted, std::vector<Stats>& refused) {
  std::vector<Candidate> candidates;
  for (const MethodChoice& chosen : chosen_methods(session, setup, o.request, wanted, o.json)) {
    show_progress(fmt::format("verify: pipelines of {}", chosen.method->name));
    try {
      candidates.emplace_back(session.lighting(*chosen.method, chosen.options, parse_path(o.request.path)),
                              chosen.options, setup.view.width());
    } catch (const Error& error) {
      if (!o.methods.empty()) throw;
      refused.push_back(refused_row(o.request, session, setup, *chosen.method, error));
    }
  }
  if (candidates.empty()) throw Error(refused.front().judgement->reason);
  return candidates;
}

/// Over `image`, if the options ask for it.
void write_misses(const VerifyOptions& o, std::span<Candidate> candidates, const HdrImage& image) {
  if (o.out.empty()) return;
  std::vector<MethodMisses> methods;
  for (Candidate& candidate : candidates) {
    collect_misses(candidate);
    methods.push_back({.method = std::string(candidate.lighting.info().method->name),
                       .missed = candidate.findings.missed + candidate.decals.findings(candidate.lighting).missed +
                                 candidate.probes.findings(candidate.lighting).missed,
                       .pixels = std::move(candidate.misses)});
  }
  const LdrImage map = draw_misses(methods, tone_map(image, automatic_exposure(image)));
  write_output(utf8_path(o.out), [&](const auto& file) { write_png(file, map); });
}

void print_rows(const VerifyOptions& o, Session& session, const Setup& setup, std::span<const Stats> rows) {
  if (o.json) return print_json(rows);
  const DeviceRow& device = session.context().row();
  print_out("{} ({}), {} {}{}x{}, {} lights: {}\n", device.name, device.driver, o.request.scene,
            setup.views.size() == 1 ? "" : fmt::format("{} views of ", setup.views.size()), setup.view.width(),
            setup.view.height(), setup.lights.size(), setup.lights_note);
  if (rows.front().verifier == Verifier::gpu) print_out("truth by the GPU verifier\n");
  if (!rows.front().image_max_abs_diff)
    print_out("pictures not compared: {}\n", o.request.still_occlusion != 0 ? "lists leave out lights that walls hide"
                                                                            : "too many lights for brute force");
  if (const std::uint64_t pairs = rows.front().findings->boundary_pairs; pairs != 0)
    print_out(
        "{} pairs of pixel and light lie on a boundary (within 1e-5 of it): not checked, either answer is right\n",
        pairs);
  print_table(rows);
  if (rows.front().still) print_still(*rows.front().still);
  if (rows.front().mirror) print_mirror(*rows.front().mirror);
  if (const auto& shadows = rows.front().shadows) print_out("shadows: {}\n", shadow_words(*shadows));
  if (const auto& shadows = rows.front().shadows; shadows && shadows->truth)
    print_out("shadows: {}\nshadows: {}{}\n", truth_words(*shadows->truth), cut_words(*shadows->truth),
              shadows->truth->is_right() ? "" : "  FAILED: cuts lose what maps light");
}

std::uint64_t pairs_of(const Setup& setup, std::uint32_t samples = 1) {
  return setup.views.size() * setup.view.width() * setup.view.height() * samples * setup.lights.size();
}

/// The GPU verifier knows of lights alone, and of one view with one sample a pixel.
bool knows_all(const VerifyOptions& o, const Setup& setup) {
  return setup.boxes() == 0 && o.request.depth_samples <= 1 && setup.views.size() == 1;
}

void check_verifier(const VerifyOptions& o, const Setup& setup) {
  if (o.verifier != "gpu" || knows_all(o, setup)) return;
  throw Error(fmt::format("--verifier gpu: {} are checked by the oracle alone; use --verifier oracle",
                          setup.views.size() > 1        ? "several views"
                          : o.request.depth_samples > 1 ? "several samples a pixel"
                                                        : "decals and probes"));
}

Exit verify(const VerifyOptions& o) {
  if (!o.at_points.cut.empty())
    throw Error("--cut: shows a method's look-up by position, not --still-lists; expected --still-lists off");
  const ShadingPath path = parse_path(o.request.path);
  const std::vector<std::string> wanted = wanted_methods(o);
  constexpr std::string_view PICTURES[] = {".png"};
  if (!o.out.empty()) check_output("--out", o.out, PICTURES);
  const Setup setup = make_setup(o.request);
  check_verifier(o, setup);
  Session session(o.request, setup);
  const std::uint64_t pairs = pairs_of(setup, o.request.depth_samples);
  const VerifierChoice choice = parse_verifier(o.verifier, session.context());
  const Verifier verifier = knows_all(o, setup) ? chosen(choice, pairs_of(setup)) : Verifier::oracle;
  std::vector<Stats> refused;
  std::vector<Candidate> candidates = make_candidates(o, session, setup, wanted, refused);
  show_progress("verify picture: brute force");
  std::optional<HdrImage> reference;
  HdrImage first;  // where there is no reference
  // Lights shine through walls, but for those that lists leave out because walls hide them.
  const bool same = o.request.still_occlusion == 0;
  const bool possible = same && setup.lights.size() + setup.boxes() <= brute_force_lights(session.context());
  if (possible && (verifier == Verifier::oracle || pairs <= brute_force_pairs(session.context()))) {
    session.split_still(false);
    Lighting brute = session.lighting(parse_method("all"), {}, path);
    reference = render_views(session.renderer(), brute, setup.lights, setup.decals, {}).image;
    session.split_still(true);
  } else {
    first = session.renderer().render(candidates.front().lighting).image;  // and its depth
  }
  const bool any_cut = std::ranges::any_of(candidates, [&](const Candidate& c) { return is_cut(session, c.lighting); });
  if (any_cut && verifier == Verifier::gpu)
    throw Error(
        "--verifier gpu: knows nothing of shadows, which options occlusion=radial and proxy=cut ask for; use oracle");
  if (verifier == Verifier::gpu)
    find_by_gpu(session, setup, candidates);
  else
    find_by_oracle(session, setup, candidates);
  find_boxes(session, setup, candidates);
  const std::optional<ShadowFindings> shadows = shadow_findings(session, setup);
  const std::optional<StillStats> still = check_still_lists(o.request, session, setup, o.at_points.points);
  const std::optional<MirrorStats> mirror = verify_mirror(session, setup, candidates.front().lighting);

  std::vector<Stats> rows;
  for (Candidate& candidate : candidates) {
    rows.push_back(make_row(o, session, setup, candidate, reference));
    rows.back().verifier = verifier;
    if (rows.back().shadows) rows.back().shadows->truth = shadows;
    rows.back().still = still;
    if (mirror) rows.back().mirror = mirror;
  }
  rows.insert(rows.end(), refused.begin(), refused.end());
  show_progress("");
  write_misses(o, candidates, reference ? *reference : first);
  print_rows(o, session, setup, rows);
  if (!o.out.empty() && !o.json) print_out("picture: {}\n", o.out);
  Verdict worst = Verdict::ok;
  for (const Stats& row : rows) worst = std::max(worst, row.judgement->verdict);
  if (shadows && !shadows->is_right()) worst = Verdict::failed;
  if (still) worst = std::max(worst, verdict_of(*still));
  if (mirror) worst = std::max(worst, mirror->findings->verdict());
  return exit_of(worst);
}

}  // namespace

Run add_verify(CLI::App& app) {
  CLI::App* command = app.add_subcommand("verify", "Check that methods miss no light; exit code 1 if one does");
  auto o = std::make_shared<VerifyOptions>();
  o->request.size = "640x360";
  o->request.lights = 1024;
  add_common_options(*command, o->request);
  add_depth_options(*command, o->request);
  add_stereo_option(*command, o->request);
  command
      ->add_option(
          "--views", o->request.views,
          "views of a frame, turned about the vertical by equal parts of a circle; lights are culled for all of "
          "them at once, and each is checked; 1 to 8")
      ->check(whole_number(1, MAX_VIEWS))
      ->type_name("N")
      ->group("View")
      ->capture_default_str();
  add_decal_option(*command, o->request);
  add_probe_options(*command, o->request);
  add_still_options(*command, o->request);
  add_still_bytes_option(*command, o->request);
  add_shadow_options(*command, o->request);
  add_mirror_options(*command, o->request);
  add_moving_flag(*command, o->request);
  add_method_option(*command, o->methods, "method to check");
  add_option_option(*command, o->request);
  add_grow_option(*command, o->request);
  add_auto_options(*command, o->request);
  add_path_option(*command, o->request);
  add_verifier_option(*command, o->verifier);
  command
      ->add_option("--runs", o->runs,
                   "make the lists so many times; those of an ordered method must always be the same")
      ->check(whole_number(1, 100'000))
      ->type_name("N")
      ->group("Method")
      ->capture_default_str();
  command
      ->add_option("-o,--out", o->out,
                   "write a picture of where lights are missed to this file, .png: a map for each method that misses "
                   "one")
      ->type_name("FILE")
      ->group("Output");
  add_points_option(*command, o->at_points);
  add_json_flag(*command, o->json, "print the numbers as JSON, an array with one object for each method");
  command->footer(
      "Examples:\n"
      "  lamp verify atrium --lights 8192\n"
      "  lamp verify atrium --decals 64 --probes 64\n"
      "  lamp verify posts --out misses.png\n"
      "  lamp verify one-tile --lights 65536 --method lamplight --runs 100\n"
      "  lamp verify blocks --method tiled --option tile=8 --projection orthographic\n"
      "waste: lights walked for each that reaches its pixel. excess: list length over the lights that reach the cell.\n"
      "Either is inf (null in JSON) where lights are walked and none of them reaches its pixel.\n"
      "mean, longest: lights of a cell's list. difference: from brute force's picture.\n"
      "Exit code 1: a method failed. 4: none failed, but one could not be checked on this device.");
  return [o] {
    if (o->at_points.points == 0 || o->request.still_lists != "off") return verify(*o);
    if (o->request.about_generated == "--seed") o->request.about_generated = {};  // it is of the points, too
    PointsRequest of = o->at_points;
    of.methods = o->methods;
    of.json = o->json;
    return verify_points(o->request, of);
  };
}

}  // namespace lamp::app
