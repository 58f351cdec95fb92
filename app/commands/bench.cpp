// lamp bench: measures a suite or a scene, into a folder with results.json, results.csv and report.html.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "bench/calibration_file.h"
#include "bench/embedded_files.h"
#include "bench/regret.h"
#include "bench/results.h"
#include "commands/bench_candidate.h"
#include "commands/bench_folder.h"
#include "commands/bench_input.h"
#include "commands/bench_measure.h"
#include "commands/calibration.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/pictures.h"
#include "files/content_hash.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "render/judgement.h"
#include "system/print.h"
#include "system/progress.h"
#include "system/signals.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uint32_t SOFTWARE_FRAMES = 5;  // a software device takes seconds for a frame of a large suite

struct BenchOptions {
  Request request;
  std::vector<std::string> methods;
  std::string out = "bench";
  std::string verifier = "auto";
  std::string max_size;
  std::vector<std::string> series;
  std::uint32_t max_lights = MAX_LIGHTS;
  double scale = 1.0;
  std::optional<std::uint32_t> frames, warm_up;
  bool overwrite = false;
  std::string command_line;
};

/// All methods, or those named, on one scene as the options say.
Suite suite_of_scene(const BenchOptions& o, const Scene& scene) {
  Request r = o.request;
  if (scene.captured && !r.size_given)
    r.size = fmt::format("{}x{}", scene.captured->view.width(), scene.captured->view.height());
  check_generated(r, scene);
  if (scene.captured && !r.lights_given) r.lights = 0;
  Series series;
  series.name = "scene";
  series.title = fmt::format("{}, {} lights, {}", r.scene, scene.lights.size() + r.lights, r.size);
  series.scenes = {r.scene};
  series.sizes = {r.size};
  series.lights = {r.lights};
  series.spots = {r.spots};
  series.ranges = {r.range};
  series.cameras = {r.camera};
  series.projections = {r.projection};
  series.depth = r.depth;
  series.depth_samples = r.depth_samples;
  series.paths = {r.path};
  series.brdf = r.brdf;
  series.seed = r.seed;
  series.frame = r.frame;
  series.still = r.still;
  series.stereo_m = r.stereo_m;
  series.mirror = r.mirror;
  series.mirror_lists = r.mirror_lists;
  series.decals = {r.decals};
  series.probes = {r.probes};
  series.shadows = r.shadows;
  series.pictures = true;
  series.chart.x = "method";
  check_once("--method", o.methods);
  if (r.still_lists != "off" && r.still == 0.0F)
    throw Error(fmt::format("--still-lists {}: all generated lights move; expected --still PART too", r.still_lists));
  std::vector<std::string> names = o.methods;
  if (names.empty())
    for (const Method& method : methods()) names.emplace_back(method.name);
  check_one_method(names.size(), r.options);
  for (const std::string& name : names) {
    series.methods.push_back({.name = name,
                              .options = r.options,
                              .label = name,
                              .still_lists = r.still_lists,
                              .still_occlusion = r.still_occlusion,
                              .still_bytes = r.still_bytes});
    if (!is_auto(name)) static_cast<void>(parse_method(name));
  }
  return scene_suite(std::move(series));
}

/// The GPU verifier knows nothing of some frames.
void tell_verifier(const BenchOptions& o, std::span<const Group> groups) {
  if (o.verifier != "gpu") return;
  const auto others = std::ranges::count_if(groups, [](const Group& group) {
    return group.verify.what != Verify::What::nothing && group.verify.verifier == Verifier::oracle;
  });
  if (others != 0)
    print_out(
        "--verifier gpu: {} of {} groups are held against the oracle, as they have shadows, decals, probes, "
        "several samples or two eyes\n",
        others, groups.size());
}

/// What `auto` chooses depends on its calibration, which may be measured now.
void name_calibration(BenchDevice& device, std::span<Group> groups) {
  std::string hash;
  for (Group& group : groups)
    for (GroupEntry& entry : group.entries) {
      if (!is_auto(entry.name) || group.frames == 0) continue;
      if (hash.empty()) hash = hash_text(hash_of(json_text(to_json(device.chooser().calibration()), -1)));
      entry.calibration_hash = hash;
    }
}

/// Goes on with the results of an earlier run, and says how many of them it does not take.
void go_on(json& results, const json& earlier, const std::string& file, std::span<const Group> groups) {
  if (const std::size_t again = take_over(results, earlier, groups); again != 0)
    print_out(
        "{}: {} of its {} results are measured again: the files of a scene, the calibration of auto or the methods "
        "beside them have changed\n",
        file, again, earlier["results"].size());
}

/// How long a group takes, in some unit: pixels, rounds, and lights where they are many.
double weight_of(const Group& group) {
  const double rounds = group.frames + group.warm_up + (group.verify.what == Verify::What::nothing ? 1.0 : 4.0);
  return static_cast<double>(pixels_of(group.size)) * std::sqrt(256.0 + group.lights) * rounds *
         static_cast<double>(group.entries.size());
}

/// Measures what is missing, and writes the results after every group. The signal that wanted it to stop, or 0.
int measure_all(BenchDevice& device, const fs::path& folder, std::span<const Group> groups, json& results,
                bool explain) {
  const StopRequest stop;
  Progress progress;
  double all = 0.0;
  double done = 0.0;
  for (const Group& group : groups)
    if (!has_group(results, group)) all += weight_of(group);
  for (const Group& group : groups) {
    if (has_group(results, group)) continue;
    const std::string where = fmt::format("{}: {} {} {} lights: ", group.series, group.scene, group.size, group.lights);
    const auto say = [&](const std::string& words) {
      progress.clear();
      print_out("{}\n", where);
      write_out(words);
    };
    try {
      add_group(results, measure({.device = device,
                                  .group = group,
                                  .folder = folder,
                                  .progress =
                                      [&](const std::string& what, double share) {
                                        progress.show(where + what, (done + share * weight_of(group)) / all);
                                      },
                                  .stop = StopRequest::signal,
                                  .explain = explain ? say : std::function<void(const std::string&)>{}}));
    } catch (const Interrupted&) {
      break;
    }
    done += weight_of(group);
    write_text(folder / "results.json", json_text(results, 1) + "\n");
  }
  progress.clear();
  return StopRequest::signal();
}

/// One line for each result that is not right, has no times or could not be checked.
void print_faults(const json& results) {
  for (const json& entry : results["results"]) {
    const std::string verdict = entry["verdict"];
    const bool is_fault = verdict == "wrong" || verdict == "impossible" || verdict == name_of(Verdict::unchecked);
    if (is_fault || entry.value("clock_moved", false))
      print_out("{}: {}: {}\n", entry["key"].get<std::string>(), verdict, entry["reason"].get<std::string>());
  }
}

/// What devices made otherwise than was asked: once for each of a kind.
void print_notes(const json& results) {
  std::set<std::pair<std::string, std::string>> said;
  for (const json& entry : results["results"])
    for (const json& note : entry["stats"].value("notes", json::array()))
      if (said.emplace(entry["label"], note).second)
        print_out("{}: {}\n", entry["label"].get<std::string>(), note.get<std::string>());
}

/// What a run came to.
Exit conclude(const json& results, std::size_t left_out, const std::string& report) {
  const auto count = [&](std::string_view verdict) {
    return std::ranges::count_if(results["results"], [&](const json& entry) { return entry["verdict"] == verdict; });
  };
  const auto wrong = count("wrong");
  const auto unchecked = count(name_of(Verdict::unchecked));
  const auto impossible = count("impossible");
  print_faults(results);
  print_notes(results);
  if (const std::string words = regret_words(results); !words.empty()) print_out("{}\n", words);
  print_out("{} configurations measured, {} wrong, {} could not be checked, {} impossible, {} beyond the limits: {}\n",
            std::ssize(results["results"]) - impossible, wrong, unchecked, impossible, left_out, report);
  if (wrong != 0) return Exit::check_failed;
  return unchecked != 0 ? Exit::unchecked : Exit::done;
}

json results_of(const BenchOptions& o, const DeviceRow& row, const Suite& suite) {
  return new_results({.command = o.command_line,
                      .device = row.name,
                      .device_kind = row.kind,
                      .driver = row.driver,
                      .commit = std::string(built_from()),
                      .date = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))),
                      .shaders = o.request.shader_dir.empty() ? std::string(BUILT_IN)
                                                              : hash_of_shaders(utf8_path(o.request.shader_dir)),
                      .pipeline_statistics = o.request.pipeline_statistics ? "on" : std::string(OFF)},
                     suite);
}

Exit bench(const BenchOptions& o) {
  check_bench_name(o.request.scene);
  const bool from_suite = is_suite(o.request.scene);
  const Suite suite = from_suite ? load_suite(o.request.scene) : suite_of_scene(o, load_scene(o.request.scene));
  check_series(o.series, o.request.scene, suite);
  BenchDevice device(o.request);
  Expansion expansion = expand(suite, {.frames = o.frames,
                                       .warm_up = o.warm_up,
                                       .scale = o.scale,
                                       .most_frames = device.software() ? SOFTWARE_FRAMES : ~0U,
                                       .max_lights = o.max_lights,
                                       .max_pixels = o.max_size.empty() ? ~0ULL : pixels_of(o.max_size),
                                       .series = o.series,
                                       .most_pairs = brute_force_pairs(device.context()),
                                       .most_walked = brute_force_lights(device.context()),
                                       .verifier = parse_verifier(o.verifier, device.context()),
                                       .every_list = !device.software()});
  const std::span<Group> groups = expansion.groups;
  if (groups.empty() && expansion.left_out != 0)
    throw Error(fmt::format("{}: --max-lights and --max-size leave out all of its {} configurations", o.request.scene,
                            expansion.left_out));
  check_groups(from_suite ? o.request.scene : "", groups);
  check_calibration(o.request.calibration, o.request.explain || std::ranges::any_of(groups, has_auto));
  tell_verifier(o, groups);
  json results = results_of(o, device.context().row(), suite);
  const fs::path folder = utf8_path(o.out);
  const fs::path results_file = folder / "results.json";
  const std::string file = results_file.string();
  check_own_file(o.out, o.request.scene);
  const auto earlier_results = [&]() -> std::optional<json> {
    if (std::error_code none; o.overwrite || !fs::exists(results_file, none)) return std::nullopt;
    json earlier = load_results(results_file);
    check_earlier(results, earlier, file, groups);
    return earlier;
  };
  static_cast<void>(earlier_results());  // refused before the calibration is measured
  name_calibration(device, groups);
  const BenchFolder own(o.out);
  const std::optional<json> earlier = earlier_results();
  if (earlier) go_on(results, *earlier, file, groups);
  const auto all_there = [&] {
    return std::ranges::all_of(groups, [&](const Group& g) { return has_group(results, g); });
  };
  if (earlier && all_there()) results["run"] = (*earlier)["run"];  // nothing is measured now
  const int signal = measure_all(device, folder, groups, results, o.request.explain);
  if (signal != 0 && results["results"].empty()) {
    print_out("stopped before anything was measured: {} stays as it is\n", o.out);
    throw Interrupted{signal};
  }
  const bool complete = all_there();
  results["run"]["complete"] = complete;
  results["run"]["left_out"] = expansion.left_out;
  add_regret(results);
  write_all(folder, results);
  if (o.overwrite && complete) remove_pictures(folder, results);
  const Exit exit = conclude(results, expansion.left_out, (folder / "report.html").string());
  if (!complete)
    print_out("stopped before its end; the same command{} goes on\n", o.overwrite ? " without --overwrite" : "");
  if (signal != 0) throw Interrupted{signal};
  return exit;
}

/// Options that speak of a scene: a suite says its own.
void refuse_with_suite(const CLI::App& command, const std::string& name) {
  if (!is_suite(name)) return;
  const auto is_of_scene = [](const CLI::Option& option) {
    constexpr std::array GROUPS{"View", "Lights", "Shadows"};
    constexpr std::array OPTIONS{"--method", "--option", "--path"};
    return std::ranges::find(GROUPS, option.get_group()) != GROUPS.end() ||
           std::ranges::find(OPTIONS, option.get_name()) != OPTIONS.end();
  };
  for (const CLI::Option* option : command.get_options())
    if (option->count() != 0 && is_of_scene(*option))
      throw Error(
          fmt::format("{}: belongs to a scene, and {} is a suite, which says its own; a suite takes --series, "
                      "--max-lights, --max-size, --scale, --frames and --warm-up",
                      option->get_name(), name));
}

std::string shell_quoted(const std::string& word) {
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=:,+") ==
          std::string::npos)
    return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

Run add_bench(CLI::App& app, std::span<char* const> arguments) {
  CLI::App* command =
      app.add_subcommand("bench", "Measure how long methods take, on a suite or a scene; write a report");
  auto o = std::make_shared<BenchOptions>();
  o->request.scene = "quick";
  add_common_options(*command, o->request);
  add_statistics_flag(*command, o->request);
  add_depth_options(*command, o->request);
  add_stereo_option(*command, o->request);
  command->get_option("scene")->description("a suite (lamp list suites), a suite's .json file, or a scene");
  add_method_option(*command, o->methods, "method to measure on a scene");
  add_option_option(*command, o->request);
  add_auto_options(*command, o->request);
  add_path_option(*command, o->request);
  add_shadow_options(*command, o->request);
  add_decal_option(*command, o->request);
  add_probe_option(*command, o->request);
  add_still_options(*command, o->request);
  add_still_bytes_option(*command, o->request);
  add_mirror_options(*command, o->request);
  add_out_option(*command, o->out, "write to this folder; what it has results of is not measured again")
      .type_name("FOLDER");
  command->add_flag("--overwrite", o->overwrite, "measure anew, in place of all results that the folder has")
      ->group("Output");
  const auto add = [&](const char* name, auto& value, const char* help) {
    return command->add_option(name, value, help)->type_name("N")->group("Measuring");
  };
  add("--frames", o->frames, "number of frames to time; default: the suite's, on a software device at most 5")
      ->check(whole_number(1, 100000));
  add("--warm-up", o->warm_up, "number of frames before those; default: the suite's")->check(whole_number(0, 100000));
  add("--series", o->series, "measure this series of a suite alone; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME");
  add("--max-lights", o->max_lights, "leave out the parts of a suite that have more lights")
      ->check(whole_number(0, MAX_LIGHTS));
  add_verifier_option(*command, o->verifier);
  add("--max-size", o->max_size, "leave out the parts of a suite that have more pixels")->type_name("WIDTHxHEIGHT");
  add("--scale", o->scale, "multiply both sides of every size by this, for slow devices; 0.01 to 1")
      ->type_name("FACTOR")
      ->capture_default_str()
      ->check(number_between(0.01, 1.0));
  command->footer(
      "Examples:\n"
      "  lamp bench quick --out out/quick\n"
      "  lamp bench atrium --lights 16384 --size 1920x1080 --out out/atrium\n"
      "  lamp bench my_suite.json --out out/mine\n"
      "  lamp bench world --series lights --series mirror --out out/world\n"
      "  lamp bench stewart-1.6 --scale 0.25 --max-lights 1024 --out out/small\n"
      "Exit code 1: a method's output was wrong. 4: none was wrong, but one could not be checked, because the device "
      "ends its walks; it has its times. After Ctrl-C it writes what it has measured; the same command goes on.");
  // The tool by its name: where it lies is nobody else's concern, and results are passed on.
  o->command_line = utf8_path(arguments.front()).filename().string();
  for (const char* argument : arguments.subspan(1)) o->command_line += " " + shell_quoted(argument);
  // While the line is parsed, before pairs of options are looked at: a suite takes neither of a pair.
  command->parse_complete_callback([o, command] { refuse_with_suite(*command, o->request.scene); });
  return [o] {
    if (!o->max_size.empty() && pixels_of(o->max_size) == 0)
      throw Error(
          fmt::format("--max-size '{}': expected WIDTHxHEIGHT, both at least 1, such as 1920x1080", o->max_size));
    return bench(*o);
  };
}

}  // namespace lamp::app
