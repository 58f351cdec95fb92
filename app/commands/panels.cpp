// Draws the panels and measures the tests.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), figure 1.5.
// SPDX-License-Identifier: Apache-2.0
#include "commands/panels.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>

#include "commands/pictures.h"
#include "commands/stats.h"
#include "files/read_json.h"
#include "render/heatmap.h"
#include "system/print.h"

namespace lamp::app {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 4> PANELS{{{"stewart-baseline", "baseline"},
                                                                     {"stewart-half-z", "Half Z"},
                                                                     {"stewart-modified-half-z", "Modified Half Z"},
                                                                     {"stewart-aabb", "Modified Half Z, AABB"}}};

/// The tests of the table: options of `tiled`.
const std::vector<std::vector<std::string>>& tests() {
  static const std::vector<std::vector<std::string>> list{
      {"test=planes"},
      {"test=aabb"},
      {"test=planes+aabb"},
      {"test=cone-approximate"},
      {"test=cone"},
      {"test=exact"},
      {"test=exact", "bounds=mask"},
      {"test=exact", "bounds=mask", "spot=cone-sphere"},
      {"test=exact", "bounds=mask", "spot=cone-segments"},
      {"test=exact", "bounds=mask", "spot=cone-segments", "prune=pixel"},
  };
  return list;
}

std::uint32_t largest(std::span<const std::uint32_t> counts) {
  std::uint32_t most = 1;
  for (const std::uint32_t count : counts)
    if (count != SKY_CELL) most = std::max(most, count);
  return most;
}

/// The colours of the scale by themselves, from 0 to its top, as wide as a panel.
LdrImage legend(std::uint32_t width, std::uint32_t height, std::uint32_t scale_max) {
  LdrImage image{width, height, std::vector<glm::u8vec4>(std::size_t{width} * height, glm::u8vec4(16, 16, 20, 255))};
  const auto steps = static_cast<std::uint32_t>(std::bit_width(scale_max));
  const std::uint32_t scale = width >= 480 ? 2 : 1;
  const std::uint32_t row = height / (steps + 2);
  draw_text(image, 8, static_cast<std::int32_t>(row / 4), "lights per tile, logarithmic", {230, 230, 230}, scale);
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const std::uint32_t count = i == 0 ? 0 : 1U << (i - 1);
    const auto y = static_cast<std::int32_t>((i + 1) * row);
    fill_rect(image, {8, y}, {static_cast<int>(width / 2), static_cast<int>(row)}, heat_color(count, scale_max));
    draw_text(image, static_cast<std::int32_t>(width / 2 + 20), y + static_cast<std::int32_t>(row / 4),
              std::to_string(count), {230, 230, 230}, scale);
  }
  return image;
}

/// A test, and what its tiles were found to hold.
struct Row {
  std::string options;
  Lighting lighting;
  Verification verification;
};

/// Bits, because a list that overflows would count as every light.
Row make_row(Session& session, const Setup& setup, std::vector<std::string> options) {
  const std::string words = fmt::format("{}", fmt::join(options, " "));
  options.emplace_back("container=bits");
  return {words, session.lighting(parse_method("tiled"), options, ShadingPath::deferred),
          Verification(setup.view.width())};
}

std::vector<Row> measure(Session& session, const Setup& setup) {
  std::vector<Row> rows;
  for (const std::vector<std::string>& options : tests()) rows.push_back(make_row(session, setup, options));
  static_cast<void>(session.renderer().render(rows.front().lighting));  // for its depth
  const std::vector<float> depth = session.renderer().read_depth();
  for_each_truth({.view = setup.view, .depth = depth, .lights = setup.lights, .rows = setup.view.height()},
                 [&](const Truth& truth) {
                   for (Row& row : rows) row.verification.add(truth, session.renderer().visit(row.lighting, truth));
                 });
  return rows;
}

Judgement judgement_of(const Row& row) {
  return judge(row.lighting.runner().plan(), row.verification.findings(), std::nullopt);
}

void print_rows(std::span<const Row> rows, bool json) {
  nlohmann::json array = nlohmann::json::array();
  if (!json) print_out("{:<62} {:>8} {:>8} {:>8} {:>8}\n", "test", "excess", "waste", "mean", "missed");
  for (const Row& row : rows) {
    const Findings f = row.verification.findings();
    const Judgement judgement = judgement_of(row);
    if (!json) {
      print_out("{:<62} {:>8} {:>8.2f} {:>8.1f} {:>8}\n", row.options,
                f.excess() ? fmt::format("{:.2f}", *f.excess()) : "-", f.waste(), f.list_mean(), f.missed);
      if (!judgement.reason.empty()) print_out("  {}: {}\n", name_of(judgement.verdict), judgement.reason);
      continue;
    }
    nlohmann::json one{{"options", row.options},
                       {"list_mean", f.list_mean()},
                       {"missed", f.missed},
                       {"reason", judgement.reason},
                       {"verdict", name_of(judgement.verdict)}};
    add_number(one, "excess", f.excess(), f.excess() ? NONE_USEFUL : "not counted: walks were ended");
    add_number(one, "waste", f.waste(), NONE_USEFUL);
    array.push_back(std::move(one));
  }
  if (json) write_out(json_text(array, 2) + "\n");
}

/// Picture, legend and heat maps on one scale, six panels.
LdrImage panels_of(Session& session) {
  std::vector<std::vector<std::uint32_t>> counts;
  LdrImage picture;
  std::uint32_t most = 1;
  for (const auto& [method, title] : PANELS) {
    Lighting lighting = session.lighting(parse_method(method), {}, ShadingPath::deferred);
    const HdrImage image = session.renderer().render(lighting).image;
    picture = tone_map(image, automatic_exposure(image));
    counts.push_back(walked_lights(visit_all(session, lighting)));
    most = std::max(most, largest(counts.back()));
  }
  const std::uint32_t scale = std::bit_ceil(most);
  std::vector<LdrImage> maps;
  for (std::size_t i = 0; i < PANELS.size(); ++i)
    maps.push_back(heatmap_of(session, counts[i], {.title = PANELS[i].second, .scale_max = scale}));
  picture.height = maps[0].height;  // the maps' legend strip below them
  picture.pixels.resize(std::size_t{picture.width} * picture.height, glm::u8vec4(16, 16, 20, 255));
  const LdrImage top[] = {picture, legend(picture.width, picture.height, scale), maps[0]};
  const LdrImage bottom[] = {maps[1], maps[2], maps[3]};
  const LdrImage rows[] = {side_by_side(top), side_by_side(bottom)};
  return stacked(rows);
}

}  // namespace

Exit draw_panels(const Request& request, const std::filesystem::path& out, bool json) {
  const Setup setup = make_setup(request);
  Session session(request, setup);
  std::vector<Row> rows = measure(session, setup);
  print_rows(rows, json);
  const LdrImage panels = panels_of(session);
  write_output(out, [&](const auto& file) { write_png(file, panels); });
  if (!json) print_out("panels: {}\n", out.string());
  Verdict worst = Verdict::ok;
  for (const Row& row : rows) worst = std::max(worst, judgement_of(row).verdict);
  return exit_of(worst);
}

}  // namespace lamp::app
