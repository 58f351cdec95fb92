// Draws points, asks the oracle and the look-up, and compares.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_points.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/command_line.h"
#include "commands/verify_rows.h"
#include "files/read_json.h"
#include "gpu/check.h"
#include "render/point_check.h"
#include "scene/random_points.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::size_t AT_ONCE = 1U << 16;  // points whose truth is held

/// A method at points of one kind.
struct PointRow {
  std::string method;
  std::string kind;
  std::size_t points = 0;
  PointFindings findings;
  std::uint32_t overflowed = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> notes;
};

std::vector<const Method*> methods_at_points(const Request& request, const PointsRequest& of) {
  check_once("--method", of.methods);
  std::vector<const Method*> found;
  std::string names;
  for (const Method& method : methods()) {
    if (!method.any_point) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
    if (of.methods.empty()) found.push_back(&method);
  }
  for (const std::string& name : of.methods) {
    found.push_back(&parse_method(name));
    if (!found.back()->any_point)
      throw Error(fmt::format("--points: {} has no look-up by position; expected one of: {}", name, names));
  }
  if (found.size() != 1 && !request.options.empty())
    throw Error("--option: belongs to one method; name it with --method");
  return found;
}

PointFindings check_kind(PointWalks& walks, const Setup& setup, std::span<const glm::vec3> points) {
  PointFindings sum;
  for (std::size_t first = 0; first < points.size(); first += AT_ONCE) {
    const auto part = points.subspan(first, std::min(AT_ONCE, points.size() - first));
    sum.add(check_points(walks.walk(part), truth_at(part, setup.lights), setup.lights.size()), first);
  }
  return sum;
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
  print_out("{:<16} {:<22} {:>8} {:>8} {:>12} {:>12} {:>7} {:>8}\n", "method", "points", "count", "missed", "walked",
            "reaching", "waste", "longest");
  for (const PointRow& row : rows) {
    const PointFindings& f = row.findings;
    print_out("{:<16} {:<22} {:>8} {:>8} {:>12} {:>12} {:>7.2f} {:>8}  {}\n", row.method, row.kind, row.points,
              f.missed, f.evaluations, f.useful, f.waste(), f.list_max, table_words(f.verdict()));
    if (const std::string reason = f.reason(); !reason.empty()) print_out("  {}\n", reason);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i != 0 && rows[i].method == rows[i - 1].method) continue;
    for (const std::string& note : rows[i].notes) print_out("note: {}: {}\n", rows[i].method, note);
    if (rows[i].overflowed != 0)
      print_out("{}: {} cells did not fit, and their points walk every light: give it more room (lamp list methods)\n",
                rows[i].method, rows[i].overflowed);
  }
  print_out("waste: lights walked for each that reaches its point; {}\n",
            std::ranges::all_of(rows, [](const PointRow& row) { return row.findings.verdict() == Verdict::ok; })
                ? "no point misses a light"
                : "see the rows that are not ok");
}

}  // namespace

void add_points_option(CLI::App& command, std::uint32_t& points) {
  command
      .add_option("--points", points,
                  "check look-ups by position instead, at so many random points of each kind: on surfaces, in the air, "
                  "anywhere, and 100 km away")
      ->check(whole_number(1, 10'000'000))
      ->type_name("N")
      ->group("Method");
}

Exit verify_points(const Request& request, const PointsRequest& of) {
  const std::vector<const Method*> chosen = methods_at_points(request, of);
  for (const Method* method : chosen) check_request(request, std::string(method->name));
  const Setup setup = make_setup(request);
  const ShaderLibrary shaders(request.shader_dir);
  Context context({.device = request.device});
  const PointSource source(setup.scene, find_open_air(setup.scene),
                           glm::vec3(glm::dmat4(setup.view.world_from_view())[3]));
  std::vector<PointRow> rows;
  for (const Method* method : chosen) {
    Plan plan = take(make_plan(*method, {.width = setup.view.width(),
                                         .height = setup.view.height(),
                                         .light_capacity = static_cast<std::uint32_t>(setup.lights.size()),
                                         .options = take(resolve_options(*method, request.options)),
                                         .traits = context.device().traits}));
    PointWalks walks(context, shaders, std::move(plan), setup.view, setup.lights);
    for (const PointKind kind : POINT_KINDS) {
      show_progress(fmt::format("verify points: {}, {}", method->name, name_of(kind)));
      const std::vector<glm::vec3> points = source.draw(kind, of.points, request.seed);
      PointRow row{.method = std::string(method->name), .kind = std::string(name_of(kind)), .points = points.size()};
      row.findings = check_kind(walks, setup, points);
      row.overflowed = walks.counts().counters.overflowed_cells;
      row.bytes = walks.plan().bytes();
      row.notes = walks.plan().notes;
      rows.push_back(std::move(row));
    }
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
  return exit_of(worst);
}

}  // namespace lamp::app
