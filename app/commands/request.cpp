// Parses common options; loads scenes; opens sessions.
// SPDX-License-Identifier: Apache-2.0
#include "commands/request.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <limits>

#include "commands/command_line.h"
#include "gpu/check.h"
#include "scene/builtin.h"
#include "scene/capture.h"
#include "scene/flight.h"
#include "scene/gltf.h"
#include "scene/place_decals.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void unknown(const char* what, const std::string& given, std::span<const std::string_view> names) {
  throw Error(fmt::format("{} '{}': there is none of that name; the nearest are {}", what, given,
                          fmt::join(nearest_names(given, names), ", ")));
}

template <class Number>
bool parse_number(std::string_view text, Number& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string range_note(std::span<const Light> lights) {
  if (lights.empty()) return "";
  const auto [low, high] = std::ranges::minmax(lights, {}, &Light::range);
  return fmt::format(" (range {:.2f} to {:.2f} m)", low.range, high.range);
}

void check_scene_lights(const Scene& scene) {
  if (const auto error = check_lights(scene.lights)) throw Error(scene.name + ": " + error->text());
}

/// A capture is one view. What asks for another is an error.
View captured_view(const Request& request, const Scene& scene) {
  const View& view = scene.captured->view;
  const glm::uvec2 size = parse_size(request.size);
  if (request.size_given && size != glm::uvec2(view.width(), view.height()))
    throw Error(fmt::format("--size '{}': the capture {} has {}x{} pixels, and no others", request.size, request.scene,
                            view.width(), view.height()));
  if (request.projection != "camera")
    throw Error(fmt::format("--projection '{}': the capture {} has its own, expected none or camera",
                            request.projection, request.scene));
  static_cast<void>(find_camera(scene, request.camera));
  if (request.frame >= 0) throw Error(fmt::format("--frame: the capture {} is one frame", request.scene));
  return view;
}

View requested_view(const Request& request, const Scene& scene) {
  if (scene.captured) return captured_view(request, scene);
  const glm::uvec2 size = parse_size(request.size);
  if (request.frame < 0) return view_of(find_camera(scene, request.camera), size.x, size.y, request.projection);
  if (!scene.flight) throw Error(fmt::format("scene '{}': has no camera flight for --frame", request.scene));
  return view_of(flight_camera(*scene.flight, static_cast<std::uint32_t>(request.frame)), size.x, size.y,
                 request.projection);
}

/// A capture holds no surfaces to lie on but those that its pixels show, with the decals that were there.
void add_decals(const Request& request, Setup& setup) {
  if (request.decals == 0) return;
  if (setup.scene.captured)
    throw Error(fmt::format("--decals {}: the capture {} has its decals in its albedo and normals, expected 0",
                            request.decals, request.scene));
  const std::vector<Decal> decals = place_decals(setup.scene, request.decals, request.seed);
  setup.decals = pack(decals);
  if (const auto error = check_boxes(boxes_of(setup.decals))) throw Error(setup.scene.name + ": " + error->text());
  const std::size_t own = std::min(decals.size(), setup.scene.decals.size());
  setup.decals_note = fmt::format("{} of the scene + {} generated", own, decals.size() - own);
}

}  // namespace

void add_common_options(CLI::App& command, Request& r) {
  command
      .add_option("scene,--scene", r.scene,
                  "a built-in scene (lamp list scenes), a .gltf or .glb file, or the folder of a capture")
      ->capture_default_str();
  command.add_option("--size", r.size, "picture size, WIDTHxHEIGHT; a capture has its own")
      ->each([&r](const std::string&) { r.size_given = true; })
      ->capture_default_str();
  command
      .add_option("--lights", r.lights, "generated lights, besides the scene's own; to a capture, none unless given")
      ->check(whole_number(0, MAX_LIGHTS))
      ->each([&r](const std::string&) { r.lights_given = true; })
      ->capture_default_str();
  command.add_option("--spots", r.spots, "fraction of the generated lights that are spots, 0 to 1")
      ->check(CLI::Range(0.0F, 1.0F))
      ->capture_default_str();
  command.add_option("--range", r.range,
                     "range of generated lights in metres, MIN:MAX or one number; default: from their density");
  command.add_option("--seed", r.seed, "of the generated lights")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  command.add_option("--camera", r.camera, "a camera of the scene by name; default: its first");
  command.add_option("--frame", r.frame, "frame of the scene's camera flight instead of a camera; lights move too")
      ->check(whole_number(0, std::numeric_limits<int>::max()));
  command.add_option("--projection", r.projection, "camera, perspective, infinite, orthographic or off-centre")
      ->capture_default_str();
  command.add_option("--brdf", r.brdf, "ggx or blinn-phong")->capture_default_str();
  command.add_option("--device", r.device, "number or part of the name of a device (lamp list devices)");
  command.add_flag("--pipeline-statistics", r.pipeline_statistics,
                   "registers and what else the driver says of each pass, in the stats; needs a driver that does");
  command.add_option("--shader-dir", r.shader_dir,
                     "a checkout of Lamplight whose shaders are compiled anew, with glslc");
}

void add_method_options(CLI::App& command, Request& r) {
  command.add_option("--method", r.method, "culling method (lamp list methods), or auto: whichever takes least time")
      ->capture_default_str();
  command.add_option("--option", r.options, "option of the method, KEY=VALUE; may be given more than once")
      ->allow_extra_args(false);
  command.add_option("--path", r.path, "forward, tiled-deferred, deferred or standard-deferred")->capture_default_str();
}

void add_grow_option(CLI::App& command, Request& r) {
  command.add_flag("--grow", r.grow,
                   "make room for what does not fit, as an engine's Culler does, and say which options that takes");
}

void add_auto_options(CLI::App& command, Request& r) {
  command.add_flag("--explain", r.explain, "say what auto predicts for each candidate, and why it takes one");
  command
      .add_option(
          "--calibration", r.calibration,
          "file of costs that auto goes by, or measure: anew, now; default: measured at a GPU's first use, kept "
          "in the user's cache folder")
      ->envname("LAMPLIGHT_CALIBRATION");
}

void add_decal_option(CLI::App& command, Request& r) {
  command
      .add_option("--decals", r.decals,
                  "box decals, culled and looked up as lights are: the scene's own, then generated ones; a capture has "
                  "those it was taken with")
      ->check(whole_number(0, 65536))
      ->capture_default_str();
}

glm::uvec2 parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  glm::uvec2 size(0);
  if (x == std::string::npos || !parse_number(std::string_view(text).substr(0, x), size.x) ||
      !parse_number(std::string_view(text).substr(x + 1), size.y) || size.x == 0 || size.y == 0)
    throw Error(fmt::format("--size '{}': expected WIDTHxHEIGHT, both at least 1, such as 1280x720", text));
  return size;
}

std::pair<float, float> parse_range(const std::string& text) {
  if (text.empty()) return {0.0F, 0.0F};
  const std::size_t colon = text.find(':');
  float low = 0.0F;
  float high = 0.0F;
  const bool parsed =
      parse_number(std::string_view(text).substr(0, colon), low) &&
      parse_number(colon == std::string::npos ? std::string_view(text) : std::string_view(text).substr(colon + 1),
                   high);
  if (!parsed || !(low > 0.0F) || !(high >= low) || !std::isfinite(high))
    throw Error(fmt::format("--range '{}': expected MIN:MAX in metres with 0 < MIN <= MAX", text));
  return {low, high};
}

ShadingPath parse_path(const std::string& text) {
  const auto found = std::ranges::find(path_names(), text);
  if (found == path_names().end()) unknown("--path", text, path_names());
  return static_cast<ShadingPath>(found - path_names().begin());
}

Brdf parse_brdf(const std::string& text) {
  if (text == "ggx") return Brdf::ggx;
  if (text == "blinn-phong") return Brdf::blinn_phong;
  throw Error(fmt::format("--brdf '{}': expected ggx or blinn-phong", text));
}

VerifierChoice parse_verifier(const std::string& text, const Context& context) {
  if (text == "oracle") return VerifierChoice::oracle;
  if (text == "auto") return context.has_doubles() ? VerifierChoice::by_pairs : VerifierChoice::oracle;
  if (!context.has_doubles())
    throw Error(
        fmt::format("--verifier gpu: device {} lacks the feature shaderFloat64; expected oracle", context.row().name),
        Exit::no_device);
  return VerifierChoice::gpu;
}

void add_verifier_option(CLI::App& command, std::string& verifier) {
  command
      .add_option("--verifier", verifier,
                  fmt::format("who says which lights reach a pixel: oracle (CPU), gpu, or auto: the oracle up to {} "
                              "billion pairs of pixel and light",
                              ORACLE_PAIRS / 1'000'000'000))
      ->check(CLI::IsMember({"oracle", "gpu", "auto"}))
      ->capture_default_str();
}

std::uint64_t brute_force_pairs(const Context& context) {
  return context.row().kind == "CPU" ? 3'000'000'000 : 200'000'000'000;
}

const Method& parse_method(const std::string& text) { return *take(find_method(text)); }

bool is_auto(std::string_view method) { return method == "auto"; }

void check_request(const Request& request, const std::string& method) {
  if (!is_auto(method)) static_cast<void>(take(resolve_options(parse_method(method), request.options)));
  if (is_auto(method) && !request.options.empty())
    throw Error("--option: belongs to one method, and auto chooses its own; name it with --method");
  static_cast<void>(parse_size(request.size));
  static_cast<void>(parse_range(request.range));
  static_cast<void>(parse_path(request.path));
  static_cast<void>(parse_brdf(request.brdf));
}

Scene load_scene(const std::string& name) {
  const auto builtin = std::ranges::find(builtin_scenes(), std::string_view(name), &BuiltinScene::name);
  if (builtin != builtin_scenes().end()) return builtin->make();
  const fs::path path(name);
  std::error_code not_there;
  if (fs::is_directory(path, not_there)) return load_capture(path);
  if (path.filename() == CAPTURE_FILE) return load_capture(path.has_parent_path() ? path.parent_path() : ".");
  const std::string extension = path.extension().string();
  if (extension == ".gltf" || extension == ".glb") return load_gltf(path);
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  throw Error(
      fmt::format("scene '{}': is neither a built-in scene nor a .gltf or .glb file nor the folder of a capture; the "
                  "nearest are {}",
                  name, fmt::join(nearest_names(name, names), ", ")));
}

Setup make_setup(const Request& request) {
  const auto [min_range, max_range] = parse_range(request.range);
  Setup setup;
  setup.scene = load_scene(request.scene);
  check_scene_lights(setup.scene);
  setup.view = requested_view(request, setup.scene);

  setup.generated =
      place_lights(setup.scene, {.count = setup.scene.captured && !request.lights_given ? 0 : request.lights,
                                 .spots = request.spots,
                                 .min_range = min_range,
                                 .max_range = max_range,
                                 .seed = request.seed,
                                 .frame = static_cast<std::uint32_t>(std::max(0, request.frame)),
                                 .frames = setup.scene.flight ? setup.scene.flight->frames : 300});
  setup.lights = pack(setup.scene.lights);
  const std::vector<shared::Light> packed = pack(setup.generated);
  setup.lights.insert(setup.lights.end(), packed.begin(), packed.end());
  setup.lights_note = fmt::format("{} generated{} + {} of the scene", setup.generated.size(),
                                  range_note(setup.generated), setup.scene.lights.size());
  add_decals(request, setup);
  return setup;
}

Session::Session(const Request& request, const Setup& setup, ContextInfo::Validation validation)
    : setup_(setup), brdf_(parse_brdf(request.brdf)), grow_(request.grow), shaders_(request.shader_dir) {
  context_ = std::make_unique<Context>(ContextInfo{
      .device = request.device, .validation = validation, .pipeline_statistics = request.pipeline_statistics});
  gpu_scene_ = std::make_unique<GpuScene>(*context_, setup.scene);
  renderer_ = std::make_unique<Renderer>(*context_, shaders_, *gpu_scene_, setup.view.width(), setup.view.height(),
                                         static_cast<std::uint32_t>(setup.lights.size()),
                                         static_cast<std::uint32_t>(setup.decals.size()));
  renderer_->set_frame(setup.view, setup.lights, setup.decals);
}

Lighting Session::lighting(const Method& method, const std::vector<std::string>& options, ShadingPath path) const {
  LightingInfo info{.method = &method,
                    .options = take(resolve_options(method, options)),
                    .width = setup_.view.width(),
                    .height = setup_.view.height(),
                    .light_capacity = static_cast<std::uint32_t>(setup_.lights.size() + setup_.decals.size()),
                    .path = path,
                    .brdf = brdf_,
                    .transparency = !gpu_scene_->blended().empty(),
                    .captured = setup_.scene.captured.has_value(),
                    .decals = !setup_.decals.empty()};
  Lighting lighting(context_->device(), shaders_, info);
  const Options asked = info.options;
  // More than once: where one list is too short, it can hide what the next one needs.
  while (grow_) {
    std::optional<Options> more = lighting.grown(renderer_->cull(lighting).needed);
    if (!more) break;
    info.options = std::move(*more);
    info.grown = changed_options(asked, info.options);
    lighting = Lighting(context_->device(), shaders_, info);
  }
  return lighting;
}

}  // namespace lamp::app
