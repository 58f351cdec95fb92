// Parses the values of common options; loads scenes; opens sessions.
// SPDX-License-Identifier: Apache-2.0
#include "commands/request.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>

#include "commands/command_line.h"
#include "commands/metres.h"
#include "files/utf8_path.h"
#include "gpu/check.h"
#include "render/box_shapes.h"
#include "scene/builtin.h"
#include "scene/capture.h"
#include "scene/flight.h"
#include "scene/gltf.h"
#include "scene/number_triangles.h"
#include "scene/place_decals.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

// A generated light's intensity grows with the square of its range: sums over millions of them stay finite.
constexpr float LONGEST_RANGE_M = 1e6F;

template <class Number>
bool parse_number(std::string_view text, Number& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string range_note(std::span<const Light> lights) {
  if (lights.empty()) return "";
  const auto [low, high] = std::ranges::minmax(lights, {}, &Light::range);
  if (low.range >= shared::INFINITE_RADIUS) return " (without range)";
  return fmt::format(" (range {} to {} m)", metres(low.range), metres(high.range));
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
  const HostDepth depth = parse_depth(request.depth, request.depth_samples);
  if (!depth.reversed)
    throw Error(fmt::format("--depth {}: the capture {} is kept with reversed depth, expected reversed", request.depth,
                            request.scene));
  if (depth.samples != 1)
    throw Error(fmt::format("--depth-samples {}: the capture {} has one sample a pixel, expected 1",
                            request.depth_samples, request.scene));
  static_cast<void>(find_camera(scene, request.camera));
  if (request.frame >= 0) throw Error(fmt::format("--frame, --frames: the capture {} is one frame", request.scene));
  if (request.stereo_m > 0.0F || request.views != 1)
    throw Error(
        fmt::format("{}: the capture {} is one view", request.views != 1 ? "--views" : "--stereo", request.scene));
  if (request.free_camera) throw Error(fmt::format("camera: the capture {} has its own, expected none", request.scene));
  return view;
}

PlaceLights light_placement(const Request& request, const Scene& scene) {
  const auto [min_range, max_range] = parse_range(request.range);
  const int frame = request.light_frame >= 0 ? request.light_frame : std::max(0, request.frame);
  return {.count = scene.captured && !request.lights_given ? 0 : request.lights,
          .spots = request.spots,
          .still = request.still,
          .min_range = min_range,
          .max_range = max_range,
          .seed = request.seed,
          .frame = static_cast<std::uint32_t>(frame),
          .frames = scene.flight ? scene.flight->frames : 300};
}

}  // namespace

void check_generated(const Request& request, const Scene& scene) {
  if (!scene.captured || request.lights_given) return;
  const std::string_view about = !request.about_generated.empty()   ? request.about_generated
                                 : !request.range.empty()           ? "--range"
                                 : request.spots != Request().spots ? "--spots"
                                 : request.still != Request().still ? "--still"
                                                                    : "";
  if (!about.empty())
    throw Error(fmt::format("{}: no light is generated beside those of the capture {}; expected --lights N too", about,
                            request.scene));
}

void check_scene_lights(const Request& request, const Scene& scene) {
  if (const auto error = check_shown_lights(scene.lights)) throw Error(scene.name + ": " + error->text());
  if (scene.lights.size() + request.lights > MAX_LIGHTS)
    throw Error(fmt::format("--lights {}: with the {} of the scene {}, expected at most {} together", request.lights,
                            scene.lights.size(), scene.name, MAX_LIGHTS));
}

View requested_view(const Request& request, const Scene& scene) {
  if (scene.captured) return captured_view(request, scene);
  glm::uvec2 size = parse_size(request.size);
  if (request.stereo_m > 0.0F) {
    if (size.x % 2 != 0)
      throw Error(
          fmt::format("--size {}: with --stereo expected an even width, half of it for each eye", request.size));
    size.x /= 2;
  }
  if (request.free_camera && request.frame >= 0)
    throw Error(fmt::format("--frame {}: the camera is a free one, expected no frame of the flight", request.frame));
  const Camera camera = request.free_camera  ? camera_of(*request.free_camera)
                        : request.frame >= 0 ? frame_camera(scene, request.frame)
                                             : find_camera(scene, request.camera);
  const View view = view_of(camera, size.x, size.y, request.projection);
  return parse_depth(request.depth, request.depth_samples).reversed ? view : with_standard_depth(view);
}

std::vector<View> requested_views(const Request& request, const Scene& scene) {
  const View view = requested_view(request, scene);
  if (request.stereo_m > 0.0F && request.views != 1)
    throw Error(fmt::format("--views {}: with --stereo there are two; expected one of them", request.views));
  return request.stereo_m > 0.0F ? both_eyes(view, request.stereo_m) : all_around(view, request.views);
}

std::vector<Light> requested_lights(const Request& request, const Scene& scene, const OpenAir& air) {
  return place_lights(air, light_placement(request, scene));
}

MovingLights requested_moving_lights(const Request& request, const Scene& scene, const OpenAir* air) {
  PlacedLights placed;
  if (air != nullptr) placed = place_on_paths(*air, light_placement(request, scene));
  return {.lights = packed_lights(request, scene, placed.lights),
          .paths = std::move(placed.paths),
          .first = generated_first(request) ? 0 : static_cast<std::uint32_t>(scene.lights.size())};
}

PathTime requested_time(const Request& request, const Scene& scene) {
  const PlaceLights how = light_placement(request, scene);
  return path_time(how.frame, how.frames);
}

std::vector<shared::Light> packed_lights(const Scene& scene, std::span<const Light> generated) {
  std::vector<shared::Light> lights = pack(scene.lights);
  const std::vector<shared::Light> packed = pack(generated);
  lights.insert(lights.end(), packed.begin(), packed.end());
  return lights;
}

std::vector<gpu::DecalData> requested_decals(const Request& request, const Scene& scene) {
  if (request.decals == 0) return {};
  // It holds no surfaces to lie on but those that its pixels show, with the decals that were there.
  if (scene.captured)
    throw Error(fmt::format("--decals {}: the capture {} has its decals in its albedo and normals, expected 0",
                            request.decals, request.scene));
  std::vector<gpu::DecalData> decals = pack(place_decals(scene, request.decals, request.seed));
  if (const auto error = check_boxes(boxes_of(decals))) throw Error(scene.name + ": " + error->text());
  return decals;
}

glm::uvec2 parse_size(const std::string& text, std::string_view option) {
  const std::size_t x = text.find('x');
  glm::uvec2 size(0);
  if (x == std::string::npos || !parse_number(std::string_view(text).substr(0, x), size.x) ||
      !parse_number(std::string_view(text).substr(x + 1), size.y) || std::min(size.x, size.y) == 0 ||
      std::max(size.x, size.y) > MAX_IMAGE_SIZE)
    throw Error(fmt::format("{} '{}': expected WIDTHxHEIGHT, both from 1 to {}, such as 1280x720", option, text,
                            MAX_IMAGE_SIZE));
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
  const bool without = std::isinf(low) && std::isinf(high);
  const bool in_order = low > 0.0F && high >= low;  // not of NaN
  if (!parsed || !in_order || (high > LONGEST_RANGE_M && !without))
    throw Error(fmt::format("--range '{}': expected MIN:MAX in metres with 0 < MIN <= MAX <= {}, or inf", text,
                            LONGEST_RANGE_M));
  return {low, high};
}

void check_request(const Request& request, const std::string& method) {
  std::vector<std::string> keys;
  for (const std::string& option : request.options) keys.push_back(option.substr(0, option.find('=')));
  check_once("--option", keys);
  if (!is_auto(method)) static_cast<void>(take(resolve_options(parse_method(method), request.options)));
  if (is_auto(method) && !request.options.empty())
    throw Error("--option: belongs to one method, and auto chooses its own; name it with --method");
  static_cast<void>(parse_size(request.size));
  static_cast<void>(parse_range(request.range));
  static_cast<void>(parse_path(request.path));
  static_cast<void>(parse_brdf(request.brdf));
  static_cast<void>(parse_depth(request.depth, request.depth_samples));
  static_cast<void>(parse_name("--projection", request.projection, projection_names()));
  check_shadow_choice(request);
  check_still(request);
  check_mirror(request);
  check_probes_show(request);
}

Scene load_scene(const std::string& name) {
  const auto builtin = std::ranges::find(builtin_scenes(), std::string_view(name), &BuiltinScene::name);
  if (builtin != builtin_scenes().end()) return builtin->make();
  const fs::path path = utf8_path(name);
  std::error_code not_there;
  const std::string extension = path.extension().string();
  const bool is_gltf = extension == ".gltf" || extension == ".glb";
  if (fs::is_directory(path, not_there)) {
    if (is_gltf) throw Error(fmt::format("scene '{}': is a folder, expected a glTF file", name));
    return load_capture(path);
  }
  if (path.filename() == CAPTURE_FILE) return load_capture(path.has_parent_path() ? path.parent_path() : ".");
  if (is_gltf) return load_gltf(path);
  std::vector<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back(scene.name);
  throw Error(
      fmt::format("scene '{}': is neither a built-in scene nor a .gltf or .glb file nor the folder of a capture; the "
                  "nearest are {}",
                  name, fmt::join(nearest_names(name, names), ", ")));
}

Setup make_setup(const Request& request) {
  static_cast<void>(parse_range(request.range));
  Setup setup;
  setup.scene = load_scene(request.scene);
  check_generated(request, setup.scene);
  check_scene_lights(request, setup.scene);
  if (still_kind(request.still_lists) == gpu::STILL_TRIANGLES) number_triangles(setup.scene);
  setup.views = requested_views(request, setup.scene);
  setup.view = setup.views.front();
  setup.generated = place_lights(setup.scene, light_placement(request, setup.scene));
  setup.lights = packed_lights(request, setup.scene, setup.generated);
  setup.still_lists = request.still_lists != "off";
  setup.still = still_lights(request, setup.scene, setup.generated.size());
  setup.lights_note = fmt::format("{} generated{} + {} of the scene", setup.generated.size(),
                                  range_note(setup.generated), setup.scene.lights.size());
  setup.decals = requested_decals(request, setup.scene);
  const std::size_t own = std::min(setup.decals.size(), setup.scene.decals.size());
  setup.decals_note = fmt::format("{} of the scene + {} generated", own, setup.decals.size() - own);
  setup.probes = pack(requested_probes(request, setup.scene));
  const std::size_t own_probes = std::min(setup.probes.size(), setup.scene.probes.size());
  setup.probes_note = fmt::format("{} of the scene + {} generated", own_probes, setup.probes.size() - own_probes);
  move_instances(request, setup);  // lights, decals and probes are placed where all is at rest
  return setup;
}

bool make_room(Renderer& renderer, const ShaderLibrary& shaders, Lighting& lighting, const Options& asked) {
  bool made = false;
  // More than once: where one list is too short, it can hide what the next one needs.
  while (true) {
    std::optional<Options> more = lighting.grown(renderer.cull(lighting).needed);
    std::optional<Options> any_depth = lighting.any_depth_grown(lighting.any_depth_counts().needed);
    if (!more && !any_depth) return made;
    LightingInfo info = lighting.info();
    if (more) info.options = std::move(*more);
    if (any_depth) info.any_depth_options = std::move(any_depth);
    info.grown = changed_options(asked, info.options);
    lighting = Lighting(renderer.device(), shaders, info);
    made = true;
  }
}

Session::Session(const Request& request, const Setup& setup, ContextInfo::Validation validation)
    : setup_(setup),
      brdf_(parse_brdf(request.brdf)),
      depth_(parse_depth(request.depth, request.depth_samples)),
      shadows_(requested_shadows(request, setup.scene)),
      grow_(request.grow),
      probe_budget_(request.probe_budget),
      shaders_(utf8_path(request.shader_dir)) {
  depth_.views = static_cast<std::uint32_t>(setup.views.size());
  context_ = std::make_unique<Context>(ContextInfo{
      .device = request.device, .validation = validation, .pipeline_statistics = request.pipeline_statistics});
  gpu_scene_ = std::make_unique<GpuScene>(*context_, setup.scene);
  renderer_ = std::make_unique<Renderer>(*context_, shaders_, *gpu_scene_, setup.view.width(), setup.view.height(),
                                         static_cast<std::uint32_t>(setup.lights.size()),
                                         static_cast<std::uint32_t>(setup.decals.size()), depth_);
  if (!setup.probes.empty()) make_probes(request);
  if (request.still_lists != "off") {
    still_ = make_still(request,
                        {.scene = setup.scene,
                         .margin_m = still_margin(request, bounds(setup.scene), setup.views, context_->device().traits),
                         .lights = setup.standing(),
                         .painted = !setup.decals.empty()});
    still_lists_ = std::make_unique<StillLists>(*context_, still_->kind(), setup.still, still_->words());
    renderer_->light_still(still_lists_.get());
  }
  if (shadows_) renderer_->cast_shadows(*shadows_);
  if (const auto mirror = requested_mirror(request, setup.scene)) renderer_->mirror(*mirror);
  renderer_->set_frame(setup.views, setup.lights, setup.decals);
}

void Session::split_still(bool splits) {
  if (!still_lists_) return;
  renderer_->restart_shadows();  // records change their order: shadows of both are those of a first frame
  renderer_->light_still(splits ? still_lists_.get() : nullptr);
  renderer_->set_frame(setup_.views, setup_.lights, setup_.decals);
}

void Session::move_instances() {
  renderer_->move_instances(gpu_scene_->move(*context_));
  rays_.move();
}

Lighting Session::lighting(const Method& method, const std::vector<std::string>& options, ShadingPath path) const {
  const StillLists* still = renderer_->still();
  const std::size_t listed = setup_.lights.size() - (still == nullptr ? 0 : still->lights());
  const LightingInfo info{
      .method = &method,
      .options = take(resolve_options(method, with_box_shapes(method, options, setup_.boxes() != 0))),
      .width = setup_.view.width(),
      .height = setup_.view.height(),
      .light_capacity = static_cast<std::uint32_t>(listed + setup_.boxes()),
      .path = path,
      .brdf = brdf_,
      .depth = depth_,
      .transparency = !gpu_scene_->blended().empty(),
      .captured = setup_.scene.captured.has_value(),
      .decals = !setup_.decals.empty(),
      .probes = renderer_->probes().kind(),
      .mirror = renderer_->mirror_roughness(),
      .shadows = shadows_ ? std::optional(shadows_->filter) : std::nullopt,
      .still = still == nullptr ? gpu::STILL_OFF : still->kind()};
  Lighting made(renderer_->device(), shaders_, info);
  if (grow_) make_room(*renderer_, shaders_, made, info.options);
  return made;
}

}  // namespace lamp::app
