// Mirrored light: the options, and what they do not go with.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "commands/command_line.h"
#include "commands/request.h"
#include "scene/moving.h"

namespace lamp::app {

void add_mirror_options(CLI::App& command, Request& r) {
  CLI::Option* mirror =
      command
          .add_option("--mirror", r.mirror,
                      "surfaces less rough than this mirror what is around them, with one ray a pixel; 0: none do")
          ->check(number_between(0.0, 1.0))
          ->type_name("ROUGHNESS")
          ->group("Lights")
          ->capture_default_str();
  command
      .add_option("--mirror-lists", r.mirror_lists,
                  "what the points that rays meet look lights up in: world-cells, ikkala-grid or brute-force")
      ->needs(mirror)
      ->type_name("NAME")
      ->group("Lights")
      ->capture_default_str();
}

void add_moving_flag(CLI::App& command, Request& r) {
  command.add_flag("--moving", r.moving, "small things of the scene move with the frames of the flight, as lights do")
      ->group("Lights");
}

void check_mirror(const Request& request) {
  if (request.moving && request.still_lists != "off")
    throw Error(fmt::format("--moving: --still-lists {} are made for triangles that stand still, expected off",
                            request.still_lists));
  if (request.moving && std::ranges::find(request.options, "occlusion=ahead") != request.options.end())
    throw Error("--moving: --option occlusion=ahead knows what hides lights only where it stands still, expected off");
  static_cast<void>(parse_name("--mirror-lists", request.mirror_lists, mirror_list_names()));
  if (request.mirror == 0.0F) return;
  if (request.still_lists != "off")
    throw Error(
        fmt::format("--mirror: with --still-lists {} still lights are in no list that a ray's hit can ask, "
                    "expected --still-lists off",
                    request.still_lists));
  if (request.decals != 0 && request.path == "forward")
    throw Error(
        "--mirror: with --decals on path forward no G-buffer holds what decals paint, expected --path deferred");
}

std::optional<MirrorSettings> requested_mirror(const Request& request, const Scene& scene) {
  check_mirror(request);
  if (request.mirror == 0.0F) return std::nullopt;
  if (scene.captured)
    throw Error(
        fmt::format("--mirror: the capture {} has no triangles that a ray could meet, expected a scene with "
                    "meshes",
                    request.scene));
  const std::size_t lists = parse_name("--mirror-lists", request.mirror_lists, mirror_list_names());
  return MirrorSettings{
      .roughness = request.mirror, .lists = static_cast<MirrorLists>(lists), .brdf = parse_brdf(request.brdf)};
}

void move_instances(const Request& request, Setup& setup) {
  if (!request.moving) return;
  if (setup.scene.captured)
    throw Error(fmt::format("--moving: the capture {} has no instances, expected a scene with meshes", request.scene));
  if (setup.at_rest.empty()) setup.at_rest = setup.scene.instances;
  setup.scene.instances = setup.at_rest;
  const int frame = request.light_frame >= 0 ? request.light_frame : std::max(0, request.frame);
  constexpr std::uint32_t FRAMES = 300;  // as lights have, without a flight
  setup.scene.instances = moved_instances(setup.scene, static_cast<std::uint32_t>(frame),
                                          setup.scene.flight ? setup.scene.flight->frames : FRAMES);
}

}  // namespace lamp::app
