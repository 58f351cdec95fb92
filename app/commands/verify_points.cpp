// Draws points, asks the oracle and the look-up, and compares.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_points.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "commands/calibration.h"
#include "commands/command_line.h"
#include "commands/pictures.h"
#include "commands/verify_rows.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "gpu/check.h"
#include "image/image.h"
#include "render/point_check.h"
#include "render/point_cut.h"
#include "render/scene_occluders.h"
#include "render/still_tree.h"
#include "scene/random_points.h"
#include "scene/still_triangles.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::size_t AT_ONCE = 1U << 16;  // points whose truth is held

/// A method with its options.
struct Asked {
  const Method* method = nullptr;
  std::vector<std::string> settings;

  [[nodiscard]] std::string label() const {
    return std::string(method->name) + (settings.empty() ? "" : fmt::format(" {}", fmt::join(settings, " ")));
  }
};

/// A method at points of one kind.
struct PointRow {
  std::string method;
  bool hides = false;  ///< lights that do not see a point need not be named there
  std::string kind;
  std::size_t points = 0;
  PointFindings findings;
  std::uint32_t overflowed = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> notes;
};

/// With and without occlusion, where nothing else is asked for.
std::vector<Asked> methods_at_points(const Request& request, const PointsRequest& of) {
  check_once("--method", of.methods);
  std::vector<const Method*> found;
  std::string names;
  for (const Method& method : methods()) {
    if (!method.any_point) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
    if (of.methods.empty()) found.push_back(&method);
  }
  for (const std::string& name : of.methods) {
    if (is_auto(name)) throw Error(fmt::format("--points: auto chooses for pictures; expected one of: {}", names));
    found.push_back(&parse_method(name));
    if (!found.back()->any_point)
      throw Error(fmt::format("--points: {} has no look-up by position; expected one of: {}", name, names));
  }
  check_one_method(found.size(), request.options);
  std::vector<Asked> asked;
  for (const Method* method : found) {
    asked.push_back({method, request.options});
    if (request.options.empty() && method->still) asked.push_back({method, {"occlusion=ahead"}});
  }
  return asked;
}

PointFindings check_kind(PointWalks& walks, const Setup& setup, std::span<const glm::vec3> points,
                         const Occluders* occluders, const std::string& label) {
  PointFindings sum;
  for (std::size_t first = 0; first < points.size(); first += AT_ONCE) {
    show_progress(fmt::format("verify points: {}, {} %", label, 100 * first / points.size()));
    const auto part = points.subspan(first, std::min(AT_ONCE, points.size() - first));
    const PointTruth reaching = truth_at(part, setup.lights);
    const PointTruth seen = occluders != nullptr ? seen_at(reaching, part, setup.lights, *occluders) : reaching;
    PointFindings findings = check_points(walks.walk(part), seen, setup.lights.size(), order_of(walks.plan()));
    findings.reaching = reaching.lights.size();
    sum.add(findings, first);
  }
  return sum;
}

/// What a method reads that is made ahead; nothing for others. Adds what is to say of it.
std::optional<WorldTree> made_ahead(const Plan& plan, const Options& options, const Setup& setup,
                                    std::vector<std::string>& notes) {
  if (!plan.binds(INPUT_STILL)) return std::nullopt;
  std::shared_ptr<const StillOccluders> occluders;
  if (options.word("occlusion") == "ahead") occluders = std::make_shared<StillOccluders>(still_triangles(setup.scene));
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  WorldTree tree = make_still_tree(setup.lights, options, 0.0F, std::move(occluders));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const TimeTaken time{.seconds = seconds.count(),
                       .cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC};
  for (std::string& note : notes_of(tree, time, options)) notes.push_back(std::move(note));
  return tree;
}

nlohmann::json json_of(const PointRow& row) {
  const PointFindings& f = row.findings;
  const double waste = f.waste();
  return {{"method", row.method},
          {"points", row.kind},
          {"count", row.points},
          {"missed", f.missed},
          {"evaluations", f.evaluations},
          {"useful", f.useful},
          {"reaching", f.reaching},
          {"occlusion", row.hides},
          {"waste", std::isfinite(waste) ? nlohmann::json(waste) : nlohmann::json(nullptr)},
          {"boundary_pairs", f.boundary_pairs},
          {"list_max", f.list_max},
          {"unordered", f.unordered != 0},
          {"unfollowed", f.unfollowed},
          {"overflowed_cells", row.overflowed},
          {"bytes", row.bytes},
          {"notes", row.notes},
          {"verdict", name_of(f.verdict())}};
}

void print_rows(const Request& request, const Context& context, const Setup& setup, std::span<const PointRow> rows) {
  print_out("{} ({}), {}, {} lights: {}\n", context.row().name, context.row().driver, request.scene,
            setup.lights.size(), setup.lights_note);
  print_out("{:<26} {:<22} {:>8} {:>8} {:>11} {:>11} {:>11} {:>7} {:>8}\n", "method", "points", "count", "missed",
            "walked", "reaching", "seen", "waste", "longest");
  for (const PointRow& row : rows) {
    const PointFindings& f = row.findings;
    print_out("{:<26} {:<22} {:>8} {:>8} {:>11} {:>11} {:>11} {:>7.2f} {:>8}  {}\n", row.method, row.kind, row.points,
              f.missed, f.evaluations, f.reaching, row.hides ? std::to_string(f.useful) : "", f.waste(), f.list_max,
              row.points == 0 ? "none" : table_words(f.verdict()));
    if (const std::string reason = f.reason(); !reason.empty()) print_out("  {}\n", reason);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i != 0 && rows[i].method == rows[i - 1].method) continue;
    for (const std::string& note : rows[i].notes) print_out("note: {}: {}\n", rows[i].method, note);
    if (rows[i].overflowed != 0)
      print_out("{}: {} did not fit, whose points walk every light: give it more room (lamp list methods)\n",
                rows[i].method, cell_words(rows[i].overflowed));
  }
  if (std::ranges::any_of(rows, [](const PointRow& row) { return row.points == 0; }))
    print_out("none: {} has no surface there\n", request.scene);
  print_out("waste: lights walked for each that reaches its point, or sees it where some need not be named; {}\n",
            std::ranges::all_of(rows, [](const PointRow& row) { return row.findings.verdict() == Verdict::ok; })
                ? "no point misses a light"
                : "see the rows that are not ok");
}

}  // namespace

void add_points_option(CLI::App& command, PointsRequest& of) {
  CLI::Option* points =
      command
          .add_option(
              "--points", of.points,
              "check look-ups by position instead, at so many random points of each kind: on surfaces, in the air, "
              "anywhere, and 100 km away; with --still-lists: check these at so many points of surfaces, not 10000")
          ->check(whole_number(1, 10'000'000))
          ->type_name("N")
          ->group("Method");
  command
      .add_option("--cut", of.cut,
                  "with --points: a picture (PNG) of how many lights each method names in a horizontal cut through the "
                  "scene at the camera's height")
      ->needs(points)
      ->type_name("FILE")
      ->group("Method");
}

Exit verify_points(const Request& request, const PointsRequest& of) {
  check_calibration(request.calibration, /* is_read= */ false);
  const std::vector<Asked> chosen = methods_at_points(request, of);
  constexpr std::string_view PICTURES[] = {".png"};
  if (!of.cut.empty()) check_output("--cut", of.cut, PICTURES);
  for (const Asked& asked : chosen) check_request(request, std::string(asked.method->name));
  const Setup setup = make_setup(request);
  const ShaderLibrary shaders(utf8_path(request.shader_dir));
  Context context({.device = request.device});
  const glm::vec3 eye(glm::dmat4(setup.view.world_from_view())[3]);
  const PointSource source(setup.scene, find_open_air(setup.scene), eye);
  const Occluders occluders = scene_occluders(setup.scene);
  std::vector<PointRow> rows;
  std::vector<LdrImage> cuts;
  for (const Asked& asked : chosen) {
    const Options options = take(resolve_options(*asked.method, asked.settings));
    Plan plan = take(make_plan(*asked.method, {.width = setup.view.width(),
                                               .height = setup.view.height(),
                                               .light_capacity = static_cast<std::uint32_t>(setup.lights.size()),
                                               .options = options,
                                               .traits = context.device().traits}));
    show_progress(fmt::format("verify points: {}", asked.label()));
    PointRow of_method{.method = asked.label(), .notes = plan.notes};
    const std::optional<WorldTree> tree = made_ahead(plan, options, setup, of_method.notes);
    of_method.hides = tree && options.word("occlusion") == "ahead";
    of_method.bytes = plan.bytes() + (tree ? tree->words().size_bytes() : 0);
    PointWalks walks(context, shaders, std::move(plan), setup.view, setup.lights,
                     tree ? tree->words() : std::span<const std::uint32_t>());
    for (const PointKind kind : POINT_KINDS) {
      const std::vector<glm::vec3> points = source.draw(kind, of.points, request.seed);
      PointRow row = of_method;
      row.kind = name_of(kind);
      row.points = points.size();
      row.findings = check_kind(walks, setup, points, row.hides ? &occluders : nullptr,
                                fmt::format("{}, {}", asked.label(), row.kind));
      row.overflowed = walks.counts().counters.overflowed_cells;
      rows.push_back(std::move(row));
    }
    if (!of.cut.empty())
      cuts.push_back(draw_point_cut(walks, bounds(setup.scene), eye.y,
                                    fmt::format("{}, {} lights", asked.label(), setup.lights.size())));
  }
  show_progress("");
  Verdict worst = Verdict::ok;
  for (const PointRow& row : rows) worst = std::max(worst, row.findings.verdict());
  if (of.json) {
    nlohmann::json array = nlohmann::json::array();
    for (const PointRow& row : rows) array.push_back(json_of(row));
    write_out(json_text(array, 2) + "\n");
  } else {
    print_rows(request, context, setup, rows);
  }
  if (!of.cut.empty()) write_output(utf8_path(of.cut), [&](const auto& file) { write_png(file, stacked(cuts)); });
  if (!of.cut.empty() && !of.json) print_out("picture: {}\n", of.cut);
  return exit_of(worst);
}

}  // namespace lamp::app
