// Scene, lights, renderer, lightings: each with the key of what it was made from.
// SPDX-License-Identifier: Apache-2.0
#include "view/stage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "commands/pictures.h"
#include "gpu/check.h"
#include "render/antialias.h"
#include "render/box_shapes.h"
#include "render/pixel_lights.h"
#include "scene/capture.h"
#include "scene/flight.h"
#include "view/stage_kept.h"

namespace lamp::app {
namespace {

constexpr std::size_t MOST_LIGHTINGS = 8;

std::string key_of(const LightingInfo& info, bool grow) {
  return fmt::format("{} {} {}x{} {} {} {} {} {} {} {} {} {} {} {}", info.method->name,
                     fmt::join(info.options.all(), " "), info.width, info.height, info.light_capacity,
                     static_cast<int>(info.path), static_cast<int>(info.brdf), info.decals, info.depth.samples,
                     info.depth.reversed, info.shadows ? static_cast<int>(*info.shadows) : -1, info.probes, info.mirror,
                     info.still, grow);
}

}  // namespace

Stage::Stage(Context& context, const ShaderLibrary& shaders, const std::string& calibration)
    : context_(context), shaders_(shaders), clock_(context), chooser_(context, shaders, calibration) {}

Stage::~Stage() = default;

MethodChoice Stage::choice(const Request& request, const std::string& method, const std::vector<std::string>& options) {
  if (!is_auto(method)) return {.method = &parse_method(method), .options = options};
  // While somebody flies or time goes on, the method stays.
  std::string key =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", request.scene, request.camera, request.projection, request.size,
                  request.lights, request.spots, request.range, request.seed, request.decals, request.probes);
  if (key != auto_key_) {
    auto_choice_ = chooser_.choose(
        *renderer_,
        {.scene = scene_->scene,
         .view = renderer_->view(),
         .lights = lights_->lights->all(),
         .light_capacity = static_cast<std::uint32_t>(lights_->lights->size()),
         .boxes = static_cast<std::uint32_t>(lights_->decals.size() + renderer_->probes().probes().size())});
    auto_key_ = std::move(key);
  }
  return auto_choice_;
}

Stage::Chosen Stage::lighting(const Request& request, const std::string& method,
                              const std::vector<std::string>& options) {
  const MethodChoice chosen = choice(request, method, options);
  const bool has_boxes = !lights_->decals.empty() || !renderer_->probes().probes().empty();
  LightingInfo info{
      .method = chosen.method,
      .options = take(resolve_options(*chosen.method, with_box_shapes(*chosen.method, chosen.options, has_boxes))),
      .width = renderer_->view().width(),
      .height = renderer_->view().height(),
      .light_capacity =
          static_cast<std::uint32_t>(listed_count() + lights_->decals.size() + renderer_->probes().probes().size()),
      .path = parse_path(request.path),
      .brdf = parse_brdf(request.brdf),
      .depth = renderer_->depth(),
      .transparency = !scene_->gpu->blended().empty(),
      .captured = scene_->scene.captured.has_value(),
      .decals = !lights_->decals.empty(),
      .probes = renderer_->probes().kind(),
      .mirror = renderer_->mirror_roughness(),
      .still = still_ ? still_->made.kind() : gpu::STILL_OFF};
  if (const Shadows* shadows = renderer_->shadows()) info.shadows = shadows->settings().filter;
  std::string key = key_of(info, request.grow);
  const auto found = std::ranges::find(lightings_, key, &KeptLighting::key);
  if (found != lightings_.end()) {
    lightings_.splice(lightings_.begin(), lightings_, found);
  } else {
    lightings_.push_front(
        {.key = std::move(key), .lighting = Lighting(renderer_->device(), shaders_, info), .asked = info.options});
    made_anew_ = true;
    if (request.grow) static_cast<void>(grow(lightings_.front()));
    if (lightings_.size() > MOST_LIGHTINGS) lightings_.pop_back();
  }
  if (needs_lights_here(lightings_.front().lighting)) bring_lights();
  return {.lighting = lightings_.front().lighting, .by_auto = chosen.by_auto};
}

Inspected Stage::inspected(Lighting& lighting, std::optional<std::uint32_t> light) {
  depth_ = renderer_->read_depth();
  visits_ = renderer_->visit_all(lighting);
  still_at_.reset();
  if (std::optional<StillPixels> at = still_pixels(depth_)) still_at_.emplace(std::move(*at));
  return {.renderer = *renderer_,
          .lighting = lighting,
          .shaders = shaders_,
          .scene = *scene_->gpu,
          .lights = lights_->lights->all(),
          .visits = visits_,
          .depth = depth_,
          .still = still_at_ ? &*still_at_ : nullptr,
          .light = light};
}

Shown Stage::draw(const ViewState& asked, glm::uvec2 size) {
  ViewState state = asked;
  made_anew_ = false;
  need_scene(state.request);
  const Scene& scene = scene_->scene;
  if (!scene.captured) state.request.size = fmt::format("{}x{}", size.x, size.y);
  need_frame(state, state.paused ? Captures::all : Captures::some);
  Shown shown{.number = ++number_, .view = renderer_->view(), .lights = lights_->lights};
  const auto [first_lit, second_lit] = draw_sides(state, shown);
  const glm::uvec2 picked = picked_pixel(asked);
  const bool second = state.picked && state.against && picked.x >= divider_x(state);
  Lighting& lit = second ? *second_lit : *first_lit;
  if (state.picked) {
    shown.inspection = inspect(inspected(lit, state.light), picked);
    shown.inspection->second = second;
    set_walked(second ? shown.second->stats : shown.first.stats, visits_);
  }
  add_findings(state, lit, shown);
  if (state.against && state.overlay == Overlay::difference) shown.picture_difference = picture_difference(state);
  shown.made_anew = std::exchange(made_anew_, false);
  shown.image = display_->image();
  shown.decals = boxes_of(lights_->decals);
  shown.flight_frames = scene.flight ? scene.flight->frames : 0;
  shown.captured = scene.captured.has_value();
  for (const Camera& camera : scene.cameras) shown.cameras.push_back(camera.name);
  if (!scene.captured)
    shown.scene_camera =
        state.request.frame >= 0 ? frame_camera(scene, state.request.frame) : find_camera(scene, state.request.camera);
  shown.notes = scene.notes;
  shown.state = std::move(state);
  return shown;
}

Stage::Picture Stage::picture(const ViewState& state, bool follows) {
  if (renderer_ && !follows) renderer_->restart_shadows();  // what was shown before is no part of the state
  need_frame(state, Captures::all);
  const Chosen chosen = lighting(state.request, state.request.method, state.request.options);
  if (scene_->scene.captured && state.samples > 1)
    throw Error(fmt::format("samples: got {}, but a captured frame has one sample a pixel", state.samples));
  Picture made{.radiance = render_samples(*renderer_, chosen.lighting, lights_->lights->all(), lights_->decals,
                                          {.samples = state.samples})
                               .image,
               .toned = {}};
  const std::optional<float> exposure = parse_exposure(state.exposure);
  made.toned = tone_map(made.radiance, exposure ? *exposure : automatic_exposure(made.radiance));
  return made;
}

Scene Stage::capture(const ViewState& state) {
  need_frame(state, Captures::all);
  const Scene& scene = scene_->scene;
  std::vector<Light> lights = scene.lights;
  if (scene_->air && lights_->lights->size() > lights.size()) {
    const std::vector<Light> generated = requested_lights(state.request, scene, *scene_->air);
    lights.insert(generated_first(state.request) ? lights.begin() : lights.end(), generated.begin(), generated.end());
  }
  for (const LightEdit& edit : state.edits) lights.at(edit.light) = edit.value;
  Request painted = state.request;  // by every decal at every pixel, whatever the method
  painted.path = path_names()[static_cast<std::size_t>(ShadingPath::deferred)];
  Lighting* const painter = lights_->decals.empty() ? nullptr : &lighting(painted, "all", {}).lighting;
  return captured_scene(scene, std::move(lights), renderer_->capture(painter));
}

glm::uvec2 Stage::picked_pixel(const ViewState& asked) const {
  const glm::uvec2 picked = asked.picked.value_or(glm::uvec2(0));
  if (scene_->scene.captured) return picked;
  const View& view = renderer_->view();
  // Where its middle is.
  return (glm::vec2(picked) + 0.5F) * glm::vec2(view.width(), view.height()) /
         glm::vec2(parse_size(asked.request.size));
}

Lighting& Stage::need_drawn(const ViewState& asked, glm::uvec2 size, const SideOf& of) {
  ViewState state = asked;
  need_scene(state.request);
  if (!scene_->scene.captured) state.request.size = fmt::format("{}x{}", size.x, size.y);
  need_frame(state, Captures::all);
  Lighting& made = lighting(state.request, of.method, of.options).lighting;
  static_cast<void>(renderer_->draw(made, [](vulkan::Recorder&) {}));
  return made;
}

std::vector<Proof> Stage::prove(const ViewState& state, glm::uvec2 size) {
  std::vector<SideOf> sides{{.method = state.request.method, .options = state.request.options}};
  if (state.against) sides.push_back({.method = state.against->method, .options = state.against->options});
  std::vector<Proof> proofs;
  for (const SideOf& of : sides)
    proofs.push_back(app::prove(inspected(need_drawn(state, size, of)), [&](float share) {
      progress_ = (static_cast<float>(proofs.size()) + share) / static_cast<float>(sides.size());
    }));
  progress_ = 1.0F;
  return proofs;
}

std::vector<OtherList> Stage::ask_others(const ViewState& state, glm::uvec2 size) {
  Request r = state.request;
  const Inspected of = inspected(need_drawn(state, size, {.method = r.method, .options = r.options}));
  const View& view = renderer_->view();
  const glm::uvec2 pixel = glm::min(picked_pixel(state), glm::uvec2(view.width(), view.height()) - 1U);
  const std::uint32_t number = pixel.x + view.width() * pixel.y;
  const glm::dvec3 position = view.world_position(pixel.x, pixel.y, of.depth[number]);
  if (!scene_->scene.captured) r.size = fmt::format("{}x{}", size.x, size.y);
  // Methods of the picture have its options; where both sides have one method, those of the pixel's side.
  std::vector<MethodChoice> sides{choice(r, r.method, r.options)};
  if (state.against) sides.push_back(choice(r, state.against->method, state.against->options));
  if (pixel.x >= divider_x(state)) std::ranges::reverse(sides);
  std::vector<OtherList> lists;
  for (const Method& method : methods()) {
    progress_ = static_cast<float>(lists.size()) / static_cast<float>(methods().size());
    OtherList& list = lists.emplace_back();
    list.method = method.name;
    const auto side = std::ranges::find(sides, &method, &MethodChoice::method);
    const std::vector<std::string> options = side == sides.end() ? std::vector<std::string>() : side->options;
    try {
      list.lights = lights_at(*renderer_, lighting(r, list.method, options).lighting, number);
      if (of.still != nullptr) std::ranges::copy(of.still->lights_at(number), std::back_inserter(list.lights));
      std::ranges::sort(list.lights);
      list.reaching = static_cast<std::size_t>(std::ranges::count_if(
          list.lights, [&](std::uint32_t light) { return reach(of.lights[light], position) == Reach::inside; }));
    } catch (const Error& error) {
      list.refused = error.what();
    }
  }
  progress_ = 1.0F;
  return lists;
}

}  // namespace lamp::app
