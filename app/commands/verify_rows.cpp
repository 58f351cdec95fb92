// Prints rows.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/read_json.h"
#include "system/print.h"

namespace lamp::app {
namespace {

/// "-" where there is no number.
template <class Number>
std::string number_or_dash(const char* format, const std::optional<Number>& number) {
  return number ? fmt::format(fmt::runtime(format), *number) : "-";
}

/// `kind`: of boxes, in the singular.
void print_boxes(std::string_view kind, const Findings& f) {
  print_out("  {}s: {} missed, {} walked for {} that hold their pixel ({:.2f} each), {} on a boundary\n", kind,
            f.missed, f.evaluations, f.useful, f.waste(), f.boundary_pairs);
  if (!f.first_miss.empty()) print_out("  first miss of a {}, by its id behind the lights: {}\n", kind, f.first_miss);
}

void print_numbers(const Stats& s) {
  const Findings& f = *s.findings;
  print_out("{:<24} {:>8} {:>14} {:>9.2f} {:>9} {:>9.1f} {:>9} {:>10} {:>11} {:>10.3f}  {}\n", s.method, f.missed,
            f.evaluations, f.waste(), number_or_dash("{:.2f}", f.excess()), f.list_mean(), f.list_max,
            s.rendered.counters.overflowed_cells, number_or_dash("{:.3g}", s.image_max_abs_diff), s.rendered.cull_ms,
            table_words(s.judgement->verdict));
}

/// What does not fit into the columns.
void print_more(const Stats& s) {
  const Findings& f = *s.findings;
  for (const std::string& note : s.notes) print_out("  note: {}\n", note);
  for (const std::string& words : all_overflow_words(s)) print_out("  {}\n", words);
  if (!s.judgement->reason.empty()) print_out("  {}\n", s.judgement->reason);
  if (s.approximate && !f.first_miss.empty()) print_out("  first miss: {}\n", f.first_miss);
  if (s.decal_findings) print_boxes("decal", *s.decal_findings);
  if (s.probe_findings) print_boxes("probe", *s.probe_findings);
}

}  // namespace

Stats refused_row(const Request& request, Session& session, const Setup& setup, const Method& method,
                  const Error& error) {
  const DeviceRow& device = session.context().row();
  return {.device = device.name,
          .driver = device.driver,
          .scene = request.scene,
          .method = std::string(method.name),
          .path = request.path,
          .width = setup.view.width(),
          .height = setup.view.height(),
          .views = setup.views.size(),
          .lights = setup.lights.size(),
          .decals = setup.decals.size(),
          .probes = setup.probes.size(),
          .ordered = method.ordered,
          .approximate = method.approximate,
          .judgement = Judgement{Verdict::unchecked, error.what()}};
}

std::string table_words(Verdict verdict) {
  return verdict == Verdict::failed ? "FAILED" : std::string(name_of(verdict));
}

void print_table(std::span<const Stats> rows) {
  print_out("{:<24} {:>8} {:>14} {:>9} {:>9} {:>9} {:>9} {:>10} {:>11} {:>10}  {}\n", "method", "missed", "evaluations",
            "waste", "excess", "mean", "longest", "overflowed", "difference", "cull ms", "");
  for (const Stats& s : rows) {
    if (!s.findings) {
      print_out("{:<24} {}: {}\n", s.method, table_words(s.judgement->verdict), s.judgement->reason);
      continue;
    }
    print_numbers(s);
    print_more(s);
  }
  const auto is_infinite = [](const Stats& s) {
    return s.findings && (std::isinf(s.findings->waste()) || std::isinf(s.findings->excess().value_or(1.0)));
  };
  if (std::ranges::any_of(rows, is_infinite)) print_out("inf: {}\n", NONE_USEFUL);
}

void print_json(std::span<const Stats> rows) {
  nlohmann::json array = nlohmann::json::array();
  for (const Stats& row : rows) array.push_back(to_json(row));
  write_out(json_text(array, 2) + "\n");
}

}  // namespace lamp::app
