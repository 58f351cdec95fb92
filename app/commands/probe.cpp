// lamp probe: what a reflection probe sees, sharp and rough, as a picture of all directions.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>
#include <vector>

#include "commands/commands.h"
#include "commands/pictures.h"
#include "commands/request.h"
#include "commands/stats.h"
#include "files/utf8_path.h"
#include "render/probe_capture.h"
#include "render/probe_panorama.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t HEIGHT_PX = 320;
constexpr float ROUGHNESSES[] = {0.0F, 0.4F, 1.0F};

struct ProbeOptions {
  Request request;
  std::vector<float> at;
  std::string out = "probe.png";
};

LdrImage pictures(Session& session, const ProbeAtlas& atlas) {
  std::vector<LdrImage> below;
  float exposure = 0.0F;
  for (const float roughness : ROUGHNESSES) {
    const HdrImage seen =
        probe_panorama(session.context(), session.shaders(), atlas, {.height = HEIGHT_PX, .roughness = roughness});
    if (exposure == 0.0F) exposure = automatic_exposure(seen);
    LdrImage picture = tone_map(seen, exposure);
    draw_text(picture, 8, 8, fmt::format("roughness {:.1f}", roughness), {255, 255, 255});
    below.push_back(std::move(picture));
  }
  return stacked(below);
}

Exit probe(const ProbeOptions& o) {
  check_request(o.request, "world-cells");
  constexpr std::string_view PICTURES[] = {".png"};
  check_output("--out", o.out, PICTURES);
  for (const float at : o.at)
    if (!(std::abs(at) <= FURTHEST_M))
      throw Error(
          fmt::format("--at {}: expected three numbers of metres, none beyond {:g}", fmt::join(o.at, " "), FURTHEST_M));
  const Setup setup = make_setup(o.request);
  if (setup.scene.captured)
    throw Error(
        fmt::format("scene {}: a capture is seen from one place alone, expected a scene with meshes", o.request.scene));
  Session session(o.request, setup);
  const glm::vec3 position =
      o.at.empty() ? glm::vec3(glm::dmat4(setup.view.world_from_view())[3]) : glm::vec3(o.at[0], o.at[1], o.at[2]);
  const auto lights = static_cast<std::uint32_t>(setup.lights.size());
  ProbeCaptureInfo info{.light_capacity = lights, .brdf = parse_brdf(o.request.brdf)};
  if (const Shadows* shadows = session.renderer().shadows()) info.shadows = shadows->settings();
  const ProbeAtlas atlas(session.context(), session.shaders(), 1);
  show_progress("probe: capture what is around it");
  ProbeCapture capture(session.context(), session.shaders(), session.gpu_scene(), info);
  capture.set(setup.lights);
  capture.capture(position, atlas, 0);
  const LdrImage picture = pictures(session, atlas);
  show_progress("");
  write_output(utf8_path(o.out), [&](const auto& file) { write_png(file, picture); });
  print_out("probe     at ({:.2f}, {:.2f}, {:.2f}), {} lights: {}\n", position.x, position.y, position.z, lights,
            setup.lights_note);
  if (const auto shadows = shadow_stats(capture.shadows())) print_out("shadows   {}\n", shadow_words(*shadows));
  if (atlas.clipped() != 0)
    print_out("clipped   {} texels are brighter than {}\n", atlas.clipped(), gpu::PROBE_BRIGHTEST);
  print_out("picture   {}\n", o.out);
  return Exit::done;
}

}  // namespace

Run add_probe(CLI::App& app) {
  CLI::App* command = app.add_subcommand("probe", "Write what a reflection probe sees, sharp and rough");
  auto o = std::make_shared<ProbeOptions>();
  add_scene_options(*command, o->request);
  add_brdf_option(*command, o->request);
  command->add_option("--at", o->at, "where the probe is, in metres; default: where the camera is")
      ->type_name("X Y Z")
      ->group("View")
      ->expected(3);
  add_shadow_map_options(*command, o->request);  // a capture draws all of its maps
  add_out_option(*command, o->out, "write the picture to this file, .png");
  command->footer(
      "Examples:\n"
      "  lamp probe atrium --frame 40 --out probe.png\n"
      "  lamp probe corridor --at 0.5 1.6 0.5 --lights 1024 --shadows pcf");
  return [o] { return probe(*o); };
}

}  // namespace lamp::app
