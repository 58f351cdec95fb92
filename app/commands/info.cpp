// lamp info: what a scene holds. Needs no device.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

#include "commands/commands.h"
#include "commands/metres.h"
#include "commands/request.h"
#include "files/read_json.h"
#include "scene/builtin.h"
#include "scene/scene_info.h"
#include "system/print.h"

namespace lamp::app {
namespace {

using nlohmann::json;

struct InfoOptions {
  std::string scene;
  bool json = false;
};

/// The row of a built-in scene of that name, or nothing.
const BuiltinScene* find_builtin(std::string_view name) {
  const auto found = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  return found == builtin_scenes().end() ? nullptr : &*found;
}

const char* kind_of(const InfoOptions& o, const Scene& scene) {
  return scene.captured ? "capture" : find_builtin(o.scene) != nullptr ? "built-in" : "glTF";
}

json to_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

json to_json(const LightCount& lights) {
  json object{{"count", lights.count}, {"unlimited", lights.unlimited}, {"min_range", nullptr}, {"max_range", nullptr}};
  if (lights.count > lights.unlimited) {
    object["min_range"] = lights.min_range;
    object["max_range"] = lights.max_range;
  }
  return object;
}

json to_json(const InfoOptions& o, const Scene& scene, const SceneInfo& info) {
  json cameras = json::array();
  for (const Camera& camera : scene.cameras)
    cameras.push_back({{"name", camera.name},
                       {"projection", camera.orthographic ? "orthographic" : "perspective"},
                       {"position", to_json(glm::vec3(camera.world_from_camera[3]))}});
  json object{{"scene", o.scene},
              {"kind", kind_of(o, scene)},
              {"cameras", cameras},
              {"flight_frames", scene.flight ? json(scene.flight->frames) : json()},
              {"lights",
               {{"point", to_json(info.points)},
                {"spot", to_json(info.spots)},
                {"directional", {{"count", scene.directional_lights.size()}}}}},
              {"bounds", nullptr},
              {"triangles", info.triangles},
              {"vertices", scene.vertices.size()},
              {"meshes", scene.meshes.size()},
              {"instances", scene.instances.size()},
              {"materials", scene.materials.size()},
              {"transparent_materials", info.transparent},
              {"images", scene.images.size()},
              {"decals", scene.decals.size()},
              {"probes", scene.probes.size()},
              {"bytes", {{"geometry", info.geometry_bytes}, {"images", info.image_bytes}}},
              {"notes", scene.notes}};
  if (info.bounds) object["bounds"] = {{"min", to_json(info.bounds->min)}, {"max", to_json(info.bounds->max)}};
  if (scene.captured)
    object.update({{"width", scene.captured->view.width()},
                   {"height", scene.captured->view.height()},
                   {"covered_pixels", info.covered_pixels}});
  return object;
}

void print_line(const char* label, const std::string& text) { print_out("{:<13}{}\n", label, text); }

void print_lights(const char* label, const LightCount& lights) {
  std::string words = fmt::format("{}", lights.count);
  if (lights.count > lights.unlimited)
    words += fmt::format(", range {} to {} m", metres(lights.min_range), metres(lights.max_range));
  if (lights.unlimited != 0) words += fmt::format(", {} without a range: they reach everything", lights.unlimited);
  print_line(label, words);
}

void print_cameras(const Scene& scene) {
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) names.push_back(camera.name);
  print_line("cameras", fmt::format("{}", fmt::join(names, ", ")));
  if (scene.flight)
    print_line("flight", fmt::format("{} frames, --frame 0 to {}", scene.flight->frames, scene.flight->frames - 1));
}

void print_surfaces(const Scene& scene, const SceneInfo& info) {
  if (scene.captured) {
    const std::uint64_t pixels = std::uint64_t{scene.captured->view.width()} * scene.captured->view.height();
    print_line("picture", fmt::format("{}x{}, surfaces on {:.1f} % of it", scene.captured->view.width(),
                                      scene.captured->view.height(),
                                      100.0 * static_cast<double>(info.covered_pixels) / static_cast<double>(pixels)));
    return;
  }
  print_line("triangles", fmt::format("{} in {} meshes that stand {} times in the scene", info.triangles,
                                      scene.meshes.size(), scene.instances.size()));
  print_line("materials", fmt::format("{}, {} of them transparent; {} images", scene.materials.size(), info.transparent,
                                      scene.images.size()));
  print_line("memory",
             fmt::format("{:.1f} MB of geometry, {:.1f} MB of images", 1e-6 * static_cast<double>(info.geometry_bytes),
                         1e-6 * static_cast<double>(info.image_bytes)));
}

void print_info(const InfoOptions& o, const Scene& scene, const SceneInfo& info) {
  const BuiltinScene* builtin = find_builtin(o.scene);
  print_line("scene", fmt::format("{} ({})", o.scene, kind_of(o, scene)));
  if (builtin != nullptr) print_line("", std::string(builtin->summary));
  print_cameras(scene);
  print_lights("points", info.points);
  print_lights("spots", info.spots);
  print_line("directional", fmt::format("{}", scene.directional_lights.size()));
  if (!scene.decals.empty()) print_line("decals", fmt::format("{}, shown with --decals", scene.decals.size()));
  if (!scene.probes.empty()) print_line("probes", fmt::format("{}, shown with --probes", scene.probes.size()));
  if (info.bounds) {
    const auto& [low, high] = *info.bounds;
    const glm::vec3 size = high - low;
    const auto all = [](const glm::vec3& v, const char* between) {
      return fmt::format("{}{}{}{}{}", metres(v.x), between, metres(v.y), between, metres(v.z));
    };
    print_line("bounds", fmt::format("({}) to ({}): {} m", all(low, ", "), all(high, ", "), all(size, " x ")));
  }
  print_surfaces(scene, info);
  for (const std::string& note : scene.notes) print_line("note", note);
}

Exit info(const InfoOptions& o) {
  const Scene scene = load_scene(o.scene);
  if (const auto error = check_lights(scene.lights)) throw Error(scene.name + ": " + error->text());
  const SceneInfo found = describe(scene);
  if (o.json)
    write_out(json_text(to_json(o, scene, found), 2) + "\n");
  else
    print_info(o, scene, found);
  return Exit::done;
}

}  // namespace

Run add_info(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Say what a scene holds: cameras, lights, bounds, triangles");
  auto o = std::make_shared<InfoOptions>();
  command
      ->add_option("scene", o->scene,
                   "a built-in scene (lamp list scenes), a .gltf or .glb file, or the folder of a capture")
      ->type_name("SCENE")
      ->required();
  add_json_flag(*command, o->json, "print one object");
  command->footer(
      "Examples:\n"
      "  lamp info atrium\n"
      "  lamp info city.glb --json");
  return [o] { return info(*o); };
}

}  // namespace lamp::app
