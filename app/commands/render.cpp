// lamp render: one picture, its heat map, its numbers.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <set>

#include "commands/auto_method.h"
#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/pictures.h"
#include "commands/render_frames.h"
#include "commands/stats.h"
#include "commands/view_state.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "image/write_file.h"
#include "render/antialias.h"
#include "render/leak_map.h"
#include "scene/flight.h"
#include "system/console.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

struct RenderOptions {
  std::string state_file;         ///< empty: none
  ViewState state{.samples = 0};  ///< samples: 0: as many as the scene allows and are worth the time
  std::string out = "lamp.png";
  std::string heatmap;
  std::string overlay;
  std::string heatmap_of = "lights";
  std::string stats;
  std::string frames;
  bool json = false;
};

void write_picture(const std::filesystem::path& file, const HdrImage& image, const LdrImage& toned) {
  if (extension_of(file) == ".exr")
    write_exr(file, image);
  else
    write_png(file, toned);
}

constexpr std::string_view PICTURES[] = {".png", ".exr"};
constexpr std::string_view MAPS[] = {".png"};
constexpr std::string_view NUMBERS[] = {".json"};

std::filesystem::path place_of(const std::string& file) {
  if (file.empty()) return {};
  return std::filesystem::weakly_canonical(std::filesystem::absolute(followed(utf8_path(file))));
}

void check_outputs(const RenderOptions& o) {
  check_output("--out", o.out, PICTURES);
  if (!o.heatmap.empty()) check_output("--heatmap", o.heatmap, MAPS);
  if (!o.overlay.empty()) check_output("--overlay", o.overlay, MAPS);
  const HeatOf heat = parse_heat(o.heatmap_of, o.state.request);
  if (heat != HeatOf::lights && o.heatmap.empty() && o.overlay.empty())
    throw Error(fmt::format("--heatmap-of {}: expected --heatmap or --overlay with it", o.heatmap_of));
  if (heat == HeatOf::lights && parse_path(o.state.request.path) == ShadingPath::standard_deferred &&
      !(o.heatmap.empty() && o.overlay.empty()))
    throw Error(fmt::format("{}: of the lights that pixels walk, and with --path standard-deferred they walk none",
                            o.heatmap.empty() ? "--overlay" : "--heatmap"));
  if (!o.stats.empty()) check_output("--stats", o.stats, NUMBERS);
  std::set<std::filesystem::path> files{place_of(o.state_file)};
  for (const std::string& file : {o.out, o.heatmap, o.overlay, o.stats})
    if (!file.empty() && !files.insert(place_of(file)).second)
      throw Error(fmt::format("{}: is {}, expected a file of its own for each output", file,
                              place_of(file) == place_of(o.state_file) ? "the --state" : "asked for twice"));
}

/// Before any is drawn: the pictures of a flight.
void check_numbered(const RenderOptions& o, const FrameRange& range) {
  for (std::uint32_t frame = range.first; frame <= range.last; ++frame)
    for (const auto& [option, file] : {std::pair{"--out", o.out}, {"--heatmap", o.heatmap}, {"--overlay", o.overlay}})
      if (!file.empty()) check_output(option, numbered(file, frame), PICTURES);
}

/// A line of the summary; on a terminal, as many as it takes.
void line(const std::string& label, const std::string& text) {
  constexpr std::size_t INDENT = 10;
  const std::string whole = fmt::format("{:<{}}{}", label, INDENT, printable(text));
  const std::optional<std::size_t> width = terminal_width();
  write_out((width ? wrapped(whole, *width, INDENT) : whole) + "\n");
}

/// What is drawn, and how.
void print_subject(const Stats& stats, const Setup& setup, const MethodChoice& chosen) {
  line("device", fmt::format("{} ({})", stats.device, stats.driver));
  line("scene",
       fmt::format("{}, {}{}x{}", stats.scene, stats.views == 1 ? "" : "two eyes of ", stats.width, stats.height));
  line("lights", fmt::format("{}: {}", stats.lights, setup.lights_note));
  if (!setup.probes.empty())
    line("probes", fmt::format("{}: {}{}", setup.probes.size(), setup.probes_note,
                               stats.captures ? fmt::format("; {} captured", stats.captures->captured) : ""));
  if (!setup.decals.empty()) line("decals", fmt::format("{}: {}", setup.decals.size(), setup.decals_note));
  line("method",
       fmt::format("{}{}, {} path, {} cells, {:.1f} MB", method_words(chosen), chosen.by_auto ? ", chosen by auto" : "",
                   stats.path, stats.cells, static_cast<double>(stats.bytes.back().second) * 1e-6));
  for (const std::string& note : stats.notes) line("note", note);
  if (parse_path(stats.path) == ShadingPath::standard_deferred)
    line("note", "this path draws a volume for each light: opaque surfaces walk no list of the method's");
}

/// What one frame took, and where its picture is.
void print_numbers(const RenderOptions& o, const Stats& stats) {
  if (stats.shadows) line("shadows", shadow_words(*stats.shadows));
  if (stats.shadows && stats.shadows->leaks)
    line("by rays", fmt::format("{}; {}", leak_words(*stats.shadows->leaks), lost_words(*stats.shadows->leaks)));
  if (stats.mirror) line("mirror", mirror_words(*stats.mirror));
  if (stats.mirror)
    for (const std::string& note : stats.mirror->notes) line("note", note);
  if (stats.findings && parse_path(stats.path) != ShadingPath::standard_deferred)
    line("walked", fmt::format("{} pairs of pixel and light{}; a cell's list has {:.1f} lights on average, {} at most",
                               stats.findings->evaluations, stats.still ? ", besides still lights" : "",
                               stats.findings->list_mean(), stats.findings->list_max));
  for (const std::string& words : all_overflow_words(stats)) line("overflow", words);
  std::string passes;
  for (const PassTime& pass : stats.rendered.passes)
    passes += fmt::format("{}{}{} {:.3f}", passes.empty() ? "" : ", ", pass.host ? "on the CPU: " : "", pass.name,
                          pass.ms_median);
  const bool eyes = stats.views != 1;
  line("times", fmt::format("cull {:.3f} ms{}, shade {:.3f} ms{}, frame {:.3f} ms{} ({})", stats.rendered.cull_ms,
                            eyes ? " for both eyes" : "", stats.rendered.shade_ms, eyes ? " for the left one" : "",
                            stats.rendered.frame_ms, eyes ? " with the left one's picture" : "", passes));
  if (stats.clock && stats.clock->now_mhz) line("clock", words_of(*stats.clock));
  if (stats.still) line("still", still_words(*stats.still));
  if (stats.still)
    for (const std::string& note : stats.still->notes) line("note", note);
  line("picture", o.out);
  for (const auto& [label, file] : {std::pair{"heat map", o.heatmap}, {"overlay", o.overlay}, {"stats", o.stats}})
    if (!file.empty()) line(label, file);
}

/// The same in one line, for a frame of the flight.
void print_frame(const Stats& stats, std::uint32_t frame, const std::string& file) {
  const std::uint32_t overflowed = overflowed_cells(stats);
  line(fmt::format("frame {}", frame),
       fmt::format("cull {:.3f} ms, shade {:.3f} ms, frame {:.3f} ms{}: {}", stats.rendered.cull_ms,
                   stats.rendered.shade_ms, stats.rendered.frame_ms,
                   overflowed == 0 ? "" : fmt::format(", {} did not fit", cell_words(overflowed)), file));
  if (stats.shadows) line("  shadows", shadow_words(*stats.shadows));
}

/// Samples a pixel. A captured frame has what its depth buffer has, one; and so has depth that was asked for.
std::uint32_t sample_count(const RenderOptions& o, const Scene& scene) {
  if (const std::uint32_t of_depth = o.state.request.depth_samples; of_depth > 1) {
    if (o.state.samples > 1 && o.state.samples != of_depth)
      throw Error(fmt::format("--samples: got {}, but with --depth-samples {} the picture has those", o.state.samples,
                              of_depth));
    return of_depth;
  }
  if (!scene.captured) return o.state.samples == 0 ? 4 : o.state.samples;
  if (o.state.samples > 1)
    throw Error(fmt::format("--samples: got {}, but a captured frame has one sample a pixel", o.state.samples));
  return 1;
}

/// All that pictures are drawn with.
struct Drawing {
  Session& session;
  Setup& setup;
  const MethodChoice& chosen;
  Lighting& lighting;
  Sampling sampling;
  DeviceClock& clock;
};

/// What heat maps are made of.
struct Drawn {
  Stats& stats;
  std::span<const Visit> visits;
  const LdrImage& toned;
};

/// The map by itself and over the picture, as far as they were asked for. `map`: of the picture below, or null.
void write_both(const RenderOptions& o, const LdrImage& toned, const std::function<LdrImage(const LdrImage*)>& map) {
  const auto write_map = [&](const std::string& name, const LdrImage* below) {
    if (!name.empty()) write_output(utf8_path(name), [&](const auto& file) { write_png(file, map(below)); });
  };
  write_map(o.heatmap, nullptr);
  write_map(o.overlay, &toned);
}

void write_leaks(const RenderOptions& o, const Drawing& drawing, const Drawn& drawn) {
  const std::vector<gpu::ShadowLeak> leaks = shadow_leaks(drawing.session, drawing.lighting);
  drawn.stats.shadows->leaks = sum_of(leaks);
  write_both(o, drawn.toned, [&](const LdrImage* below) {
    return draw_leak_map({.width = drawn.toned.width,
                          .height = drawn.toned.height,
                          .pixels = leaks,
                          .title = fmt::format("{} shadows against rays; full colour: all light of the pixel",
                                               o.state.request.shadows.filter),
                          .overlay = below});
  });
}

/// What was asked for with heat maps.
void write_maps(const RenderOptions& o, const Drawing& drawing, const Drawn& drawn) {
  if (o.heatmap.empty() && o.overlay.empty()) return;
  Session& session = drawing.session;
  const HeatOf of = parse_heat(o.heatmap_of, o.state.request);
  if (of == HeatOf::shadow_leaks) return write_leaks(o, drawing, drawn);
  std::vector<std::uint32_t> counts =
      of == HeatOf::lights ? walked_lights(drawn.visits) : shadow_heat(session, drawing.lighting, of);
  if (session.still() != nullptr) add_still_walks(*session.still(), all_pixel_points(session.renderer()), counts);
  const std::string title = of == HeatOf::lights
                                ? fmt::format("{}, {} lights", drawn.stats.method, drawn.stats.lights)
                                : fmt::format("{} shadow map, {}", of == HeatOf::shadow_age ? "oldest" : "smallest",
                                              o.state.request.shadows.filter);
  write_both(o, drawn.toned, [&](const LdrImage* below) {
    return heatmap_of(session, counts, {.title = title, .overlay = below, .of = of});
  });
}

/// Draws the session's frame, writes its pictures, and says what it took.
Stats draw(const RenderOptions& o, const Drawing& drawing) {
  auto& [session, setup, chosen, lighting, sampling, clock] = drawing;
  const std::optional<float> exposure = parse_exposure(o.state.exposure);
  session.renderer().wake(lighting);
  Progress progress;
  Sampling with_progress = sampling;
  with_progress.progress = [&](std::uint32_t sample) {
    progress.show(fmt::format("render: sample {} of {}", sample + 1, sampling.samples),
                  static_cast<double>(sample) / sampling.samples);
  };
  Rendered rendered = render_views(session.renderer(), lighting, setup.lights, setup.decals, with_progress);
  progress.clear();
  const Clock clock_now = clock.read();
  const std::vector<Visit> visits = visit_all(session, lighting);
  const HdrImage image = std::move(rendered.image);

  const LdrImage toned = tone_map(image, exposure ? *exposure : automatic_exposure(image));
  write_output(utf8_path(o.out), [&](const auto& file) { write_picture(file, image, toned); });
  Stats stats = make_stats(o.state.request, session, lighting, setup, std::move(rendered), sampling.frames);
  stats.clock = clock_now;
  set_walked(stats, visits);
  write_maps(o, drawing, {.stats = stats, .visits = visits, .toned = toned});
  return stats;
}

/// Writes the numbers where they were asked for.
void write_numbers(const RenderOptions& o, const nlohmann::json& json) {
  if (!o.stats.empty())
    write_output(utf8_path(o.stats), [&](const auto& file) { write_text(file, json_text(json, 2) + "\n"); });
  if (o.json) write_out(json_text(json, 2) + "\n");
}

/// A picture of each frame, numbered; numbers as an array. The first is the setup's.
void draw_flight(const RenderOptions& o, const Drawing& drawing, const FrameRange& range) {
  FlightFrames frames(o.state, drawing.setup);
  nlohmann::json all = nlohmann::json::array();
  for (std::uint32_t frame = range.first; frame <= range.last; ++frame) {
    if (frame != range.first) {
      frames.go_to(frame);
      if (!drawing.setup.at_rest.empty()) drawing.session.move_instances();
      drawing.session.renew_probes();
      drawing.session.renderer().set_frame(drawing.setup.views, drawing.setup.lights, drawing.setup.decals);
    }
    RenderOptions of_frame = o;
    for (std::string* file : {&of_frame.out, &of_frame.heatmap, &of_frame.overlay}) *file = numbered(*file, frame);
    const Stats stats = draw(of_frame, drawing);
    if (frame == range.first && !o.json) print_subject(stats, drawing.setup, drawing.chosen);
    if (!o.json) print_frame(stats, frame, of_frame.out);
    all.push_back(to_json(stats));
    all.back()["frame"] = frame;
  }
  write_numbers(o, all);
  if (!o.json && !o.stats.empty()) line("stats", o.stats);
}

/// The state of the first picture.
ViewState first_state(const RenderOptions& o, const std::optional<FrameRange>& flight) {
  ViewState state = o.state;
  if (!flight) return state;
  if (state.request.frame >= 0)
    throw Error(fmt::format("--frame {}: beside --frames {}, expected one of them", state.request.frame, o.frames));
  state.request.frame = static_cast<int>(flight->first);
  state.request.light_frame = -1;
  return state;
}

Exit render(const RenderOptions& o) {
  check_outputs(o);
  const FramesOption wanted = parse_frames(o.frames);
  const ShadingPath path = parse_path(o.state.request.path);
  check_request(o.state.request, o.state.request.method);
  static_cast<void>(parse_exposure(o.state.exposure));
  Setup setup = make_setup(first_state(o, wanted.flight));
  if (wanted.flight) {
    static_cast<void>(frame_camera(setup.scene, static_cast<int>(wanted.flight->last)));
    check_numbered(o, *wanted.flight);
  }
  const std::uint32_t samples = sample_count(o, setup.scene);
  for (const std::string& note : setup.scene.notes) print_error("{}\n", note);
  Session session(o.state.request, setup);
  const MethodChoice chosen =
      chosen_methods(session, setup, o.state.request, {&o.state.request.method, 1}, o.json).front();
  Lighting lighting = session.lighting(*chosen.method, chosen.options, path);
  check_heat(session, lighting, parse_heat(o.heatmap_of, o.state.request));
  const bool software = session.context().software();
  const std::uint32_t timed = wanted.timed != 0 ? wanted.timed : software || wanted.flight ? 1 : 20;
  // A device's first frame is slow: its driver is still translating shaders.
  const std::uint32_t warm_up = !software ? 3 : samples > 1 ? 0 : 1;
  DeviceClock clock(session.context());
  const Drawing drawing{session, setup, chosen, lighting, {.samples = samples, .frames = timed, .warm_up = warm_up},
                        clock};
  if (wanted.flight) {
    draw_flight(o, drawing, *wanted.flight);
    return Exit::done;
  }
  const Stats stats = draw(o, drawing);
  write_numbers(o, to_json(stats));
  if (o.json) return Exit::done;
  print_subject(stats, setup, chosen);
  print_numbers(o, stats);
  return Exit::done;
}

}  // namespace

Run add_render(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Render a picture, a heat map, and the times of a frame");
  auto o = std::make_shared<RenderOptions>();
  add_state_option(*command, o->state);
  add_common_options(*command, o->state.request);
  add_statistics_flag(*command, o->state.request);
  add_depth_options(*command, o->state.request);
  add_stereo_option(*command, o->state.request);
  add_picture_options(*command, o->state.request);
  add_out_option(*command, o->out, "write the picture to this file, .png or .exr");
  const auto add_output = [&](const char* name, std::string& file, const char* help) {
    command->add_option(name, file, help)->type_name("FILE")->group("Output");
  };
  add_output("--heatmap", o->heatmap, "write a heat map, .png: how many lights each pixel walks");
  add_output("--overlay", o->overlay, "write the heat map blended over the picture, .png");
  command
      ->add_option("--heatmap-of", o->heatmap_of,
                   "what heat map and overlay show: lights that a pixel walks; of the shadow maps that it looks up "
                   "the age of the oldest (shadow-age) or the size of the smallest (shadow-size); or light that "
                   "shadows let through or stop and rays do not (shadow-leaks)")
      ->type_name("WHAT")
      ->group("Output")
      ->capture_default_str();
  add_output("--stats", o->stats, "write the numbers, .json");
  add_json_flag(*command, o->json, "print the numbers as JSON");
  add_exposure_option(*command, o->state.exposure);
  command
      ->add_option("--samples", o->state.samples,
                   "samples of each pixel in the picture; numbers and heat maps show the first; default: 4, for a "
                   "capture 1")
      ->check(whole_number(1, 1024))
      ->type_name("N")
      ->group("View");
  command
      ->add_option("--frames", o->frames,
                   "number of frames to time; default: 20, on a software device 1. Or A..B: a numbered picture of each "
                   "of these frames of the flight (lamp-0040.png)")
      ->type_name("N|A..B")
      ->group("Device");
  command->footer(
      "Examples:\n"
      "  lamp render atrium --lights 4096 --out atrium.png --heatmap heat.png\n"
      "  lamp render atrium --frame 40 --decals 64 --method tight --out decals.png\n"
      "  lamp render atrium --frames 0..59 --exposure 1 --out flight.png\n"
      "  lamp render city.glb --method tiled --option tile=32 --path forward --size 1920x1080");
  return [o, command] {
    o->state_file = value_of(*command, "--state");
    check_shadow_options(*command, o->state.request.shadows.filter);
    return render(*o);
  };
}

}  // namespace lamp::app
