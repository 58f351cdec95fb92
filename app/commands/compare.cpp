// lamp compare: two methods side by side: heat maps on one scale, where they differ, numbers.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <memory>

#include "commands/auto_method.h"
#include "commands/commands.h"
#include "commands/panels.h"
#include "commands/pictures.h"
#include "commands/stats.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "render/heatmap.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

struct CompareOptions {
  Request request;
  std::string a, b;
  std::string out = "compare.png";
  bool panels = false;
  bool json = false;
};

/// One of the two.
struct Side {
  std::string label;  ///< the method, and options that were named
  Stats stats;
  HdrImage image;
  std::vector<std::uint32_t> counts;
};

Side measure(const CompareOptions& o, Session& session, const Setup& setup, const MethodChoice& chosen,
             const std::string& word) {
  show_progress(fmt::format("compare: {}", word));
  Renderer& renderer = session.renderer();
  Lighting lighting = session.lighting(*chosen.method, chosen.options, parse_path(o.request.path));
  // Both are timed in a first frame of shadows, when all is there that a first use takes.
  renderer.warm_up(lighting);
  renderer.restart_shadows();
  renderer.set_frame(setup.views, setup.lights, setup.decals);
  renderer.wake(lighting);
  Rendered rendered = renderer.render(lighting);
  const std::vector<Visit> visits = visit_all(session, lighting);
  HdrImage image = rendered.image;
  Side side{.label = chosen.by_auto ? method_words(chosen) : word,
            .stats = make_stats(o.request, session, lighting, setup, std::move(rendered), 1),
            .image = std::move(image),
            .counts = walked_lights(visits)};
  set_walked(side.stats, visits);
  return side;
}

/// Of one of the methods, as it was typed.
void check_side(const CompareOptions& o, const std::string& typed, const MethodWord& word) {
  Request request = o.request;
  request.options = word.options;
  try {
    check_request(request, word.method);
  } catch (const Error& error) {
    throw Error(fmt::format("compare '{}': {}", typed, error.what()));
  }
}

/// The two methods, as options ask for them.
std::vector<MethodChoice> chosen_sides(const CompareOptions& o, Session& session, const Setup& setup,
                                       std::span<const MethodWord> words) {
  std::vector<std::string> names;
  for (const MethodWord& word : words) names.push_back(word.method);
  std::vector<MethodChoice> chosen = chosen_methods(session, setup, o.request, names, o.json);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (!chosen[i].by_auto) chosen[i].options = words[i].options;
  return chosen;
}

/// Of a picture: options that both have tell nothing apart.
std::string title_of(const MethodChoice& side, const MethodChoice& other) {
  std::string title(side.method->name);
  const std::size_t bare = title.size();
  for (const std::string& option : side.options)
    if (side.method != other.method || std::ranges::find(other.options, option) == other.options.end())
      title += (title.size() == bare ? ":" : ",") + option;
  return title;
}

/// Lights that one walks and the other does not, pixel by pixel.
std::vector<std::uint32_t> differences(const Side& a, const Side& b) {
  std::vector<std::uint32_t> counts(a.counts.size());
  std::ranges::transform(a.counts, b.counts, counts.begin(), [](std::uint32_t x, std::uint32_t y) {
    return x == SKY_CELL ? SKY_CELL : std::max(x, y) - std::min(x, y);
  });
  return counts;
}

void print_side(const Side& side) {
  const Findings& f = *side.stats.findings;
  print_out("{:<24} {:>14} {:>9.1f} {:>9} {:>10} {:>10.3f} {:>10.3f}\n", side.label, f.evaluations, f.list_mean(),
            f.list_max, side.stats.rendered.counters.overflowed_cells, side.stats.rendered.cull_ms,
            side.stats.rendered.shade_ms);
  for (const std::string& note : side.stats.notes) print_out("  note: {}\n", note);
  for (const std::string& words : all_overflow_words(side.stats)) print_out("  {}\n", words);
}

Exit compare_panels(const CompareOptions& o) {
  check_calibration(o.request.calibration, /* is_read= */ false);
  if (!o.b.empty()) throw Error(fmt::format("compare --panels: takes one scene, got '{}' too", o.b));
  Request request = o.request;
  if (!o.a.empty()) request.scene = o.a;
  check_request(request, "tiled");
  return draw_panels(request, o.out, o.json);
}

Exit compare(const CompareOptions& o) {
  constexpr std::string_view PICTURES[] = {".png"};
  check_output("--out", o.out, PICTURES);
  if (o.panels) return compare_panels(o);
  if (o.a.empty() || o.b.empty()) throw Error("compare: expected the names of two methods, or --panels and a scene");
  const MethodWord words[] = {parse_method_word(o.a), parse_method_word(o.b)};
  for (std::size_t i = 0; i < std::size(words); ++i) check_side(o, i == 0 ? o.a : o.b, words[i]);
  const Setup setup = make_setup(o.request);
  Session session(o.request, setup);
  const std::vector<MethodChoice> chosen = chosen_sides(o, session, setup, words);
  const Side a = measure(o, session, setup, chosen[0], o.a);
  const Side b = measure(o, session, setup, chosen[1], o.b);

  const std::uint32_t scale = std::bit_ceil(std::max({1U, a.stats.findings->list_max, b.stats.findings->list_max}));
  const auto map = [&](std::span<const std::uint32_t> counts, const std::string& title) {
    return heatmap_of(session, counts, {.title = title, .scale_max = scale});
  };
  const std::string titles[] = {title_of(chosen[0], chosen[1]), title_of(chosen[1], chosen[0])};
  const LdrImage pictures[] = {tone_map(a.image, automatic_exposure(a.image)), map(a.counts, titles[0]),
                               map(b.counts, titles[1]),
                               map(differences(a, b), fmt::format("|{} - {}|", titles[0], titles[1]))};
  const LdrImage row = side_by_side(pictures);
  show_progress("");
  write_output(utf8_path(o.out), [&](const auto& file) { write_png(file, row); });
  const float difference = max_abs_difference(a.image, b.image);
  if (o.json) {
    nlohmann::json json{{"a", to_json(a.stats)}, {"b", to_json(b.stats)}};
    add_number(json, "image_max_abs_diff", difference, NOT_FINITE);
    write_out(json_text(json, 2) + "\n");
    return Exit::done;
  }
  print_out("{:<24} {:>14} {:>9} {:>9} {:>10} {:>10} {:>10}\n", "method", "evaluations", "mean", "longest",
            "overflowed", "cull ms", "shade ms");
  print_side(a);
  print_side(b);
  write_out("mean, longest: lights of a cell's list\n");
  print_out("largest difference of the pictures: {:.3g}\npicture: {}\n", difference, o.out);
  return Exit::done;
}

}  // namespace

Run add_compare(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Compare two methods: their heat maps side by side, their numbers");
  auto o = std::make_shared<CompareOptions>();
  o->request.size = "640x360";
  command
      ->add_option("a", o->a,
                   "a method (lamp list methods) and options of it, such as tiled:tile=8,test=exact; or auto; with "
                   "--panels, the scene")
      ->type_name("METHOD");
  command->add_option("b", o->b, "the other method, likewise")->type_name("METHOD");
  add_common_options(*command, o->request);
  add_statistics_flag(*command, o->request);
  add_grow_option(*command, o->request);
  add_auto_options(*command, o->request);
  add_decal_option(*command, o->request);
  add_probe_options(*command, o->request);
  add_shadow_options(*command, o->request);
  add_mirror_options(*command, o->request);
  add_moving_flag(*command, o->request);
  add_path_option(*command, o->request);
  add_out_option(*command, o->out, "write picture, heat maps and their difference to this file, .png");
  add_json_flag(*command, o->json, "print the numbers as JSON");
  command
      ->add_flag("--panels", o->panels,
                 "show one scene with four methods instead, as Stewart's figure 1.5 does, and measure each volume test")
      ->group("Method");
  command->footer(
      "Examples:\n"
      "  lamp compare tiled clustered posts --lights 16384 --out posts.png\n"
      "  lamp compare tiled:tile=8 lamplight:tile=16 --json\n"
      "  lamp compare --panels blocks --lights 16384 --out panels.png");
  return [o] { return compare(*o); };
}

}  // namespace lamp::app
