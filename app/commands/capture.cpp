// lamp capture: one frame as files, which other commands take as a scene.
// SPDX-License-Identifier: Apache-2.0
#include "scene/capture.h"
#include "files/utf8_path.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/request.h"
#include "system/print.h"

namespace lamp::app {
namespace {

struct CaptureOptions {
  Request request;
  std::string out;
  std::string lights_as = "npy";
};

LightsFormat parse_lights_as(const std::string& text) {
  constexpr std::array<std::string_view, 2> NAMES{"npy", "json"};
  return parse_name("--lights-as", text, NAMES) == 0 ? LightsFormat::npy : LightsFormat::json;
}

bool has_glass(const Scene& scene) {
  return std::ranges::any_of(scene.materials, [](const Material& m) { return m.alpha_mode == AlphaMode::blend; });
}

Exit capture(const CaptureOptions& o) {
  const LightsFormat lights = parse_lights_as(o.lights_as);
  check_request(o.request, o.request.method);
  check_capture_folder(utf8_path(o.out));
  const Setup setup = make_setup(o.request);
  for (const std::string& note : setup.scene.notes) print_error("{}\n", note);
  Session session(o.request, setup);
  std::optional<Lighting> painter;  // every decal at every pixel: what a capture shows depends on no method
  if (!setup.decals.empty()) painter = session.lighting(parse_method("all"), {}, ShadingPath::deferred);
  std::vector<Light> all = setup.scene.lights;
  all.insert(all.end(), setup.generated.begin(), setup.generated.end());
  const Scene frame =
      captured_scene(setup.scene, std::move(all), session.renderer().capture(painter ? &*painter : nullptr));
  write_capture(utf8_path(o.out), frame, lights);
  print_out("capture   {}, {}x{}\nlights    {}: {}\n", o.out, setup.view.width(), setup.view.height(),
            setup.lights.size(), setup.lights_note);
  if (!setup.decals.empty())
    print_out("decals    {}: {}; kept in albedo and normals\n", setup.decals.size(), setup.decals_note);
  if (has_glass(setup.scene)) print_out("left out  transparent surfaces\n");
  return Exit::done;
}

}  // namespace

Run add_capture(CLI::App& app) {
  CLI::App* command = app.add_subcommand("capture", "Write one frame as files, a scene for other commands");
  auto o = std::make_shared<CaptureOptions>();
  add_common_options(*command, o->request);
  add_decal_option(*command, o->request);
  add_out_option(*command, o->out, "write to this folder: a new one, an empty one, or a capture to replace")
      .required()
      ->type_name("FOLDER");
  command->add_option("--lights-as", o->lights_as, "how lights are written: npy (NumPy, compact) or json (readable)")
      ->type_name("NAME")
      ->group("Output")
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  lamp capture atrium --frame 40 --out frame\n"
      "  lamp verify frame\n"
      "docs/capture.md describes the files, for captures from other engines.");
  return [o] { return capture(*o); };
}

}  // namespace lamp::app
