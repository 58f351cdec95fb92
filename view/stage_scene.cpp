// The scene of a state, what moves in it, and the renderer that its frames need.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "commands/pictures.h"
#include "scene/number_triangles.h"
#include "view/stage_kept.h"

namespace lamp::app {
namespace {

std::string shadows_key(const ShadowChoice& of) {
  std::string key = fmt::format("{}", of.atlas);
  for (const ShadowWord& word : SHADOW_WORDS) key += " " + of.*word.value;
  return key;
}

/// What probes and mirrors of a renderer follow from.
std::string reflections_key(const Request& r) {
  std::string key = fmt::format("{} {}", r.mirror, r.mirror_lists);
  if (r.mirror > 0.0F || r.probes != 0) key += " " + r.brdf;
  if (r.probes != 0) key += fmt::format(" {} {} {}", r.probes, r.probes_show, r.seed);
  return key;
}

int frame_of(const Request& r) { return r.light_frame >= 0 ? r.light_frame : std::max(0, r.frame); }

}  // namespace

void Stage::need_scene(const Request& request) {
  const bool numbered = still_kind(request.still_lists) == gpu::STILL_TRIANGLES;
  std::string name =
      fmt::format("{}{}{}", request.scene, request.moving ? ", moving" : "", numbered ? ", numbered" : "");
  if (scene_ && scene_->name == name) return;
  auto scene = std::make_unique<KeptScene>();
  scene->name = std::move(name);
  scene->scene = load_scene(request.scene);
  if (numbered) number_triangles(scene->scene);
  scene->gpu = std::make_unique<GpuScene>(context_, scene->scene);
  display_.reset();
  renderer_.reset();
  probes_.reset();
  lightings_.clear();
  still_.reset();
  lights_.reset();
  auto_key_.clear();
  renderer_key_.clear();
  scene_ = std::move(scene);
  made_anew_ = true;
}

void Stage::move_scene(const Request& request) {
  if (!request.moving || scene_->moved_to == frame_of(request)) return;
  move_instances(request, scene_->setup);
  scene_->moved_to = frame_of(request);
  const std::vector<shared::LightSphere> moved = scene_->gpu->move(context_);
  if (renderer_) renderer_->move_instances(moved);
  scene_->rays.move();
}

void Stage::make_renderer(const Request& request, const View& view, std::string key) {
  const std::optional<ShadowSettings> shadows = requested_shadows(request, scene_->scene);
  const std::optional<MirrorSettings> mirror = requested_mirror(request, scene_->scene);
  display_.reset();
  renderer_.reset();
  probes_.reset();
  renderer_key_.clear();
  at_rest();
  std::vector<gpu::ProbeData> probes = pack(requested_probes(request, scene_->scene));
  move_scene(request);
  const auto lights = static_cast<std::uint32_t>(lights_->lights->size());
  const auto decals = static_cast<std::uint32_t>(lights_->decals.size());
  auto renderer = std::make_unique<Renderer>(context_, shaders_, *scene_->gpu, view.width(), view.height(), lights,
                                             decals, parse_depth(request.depth, request.depth_samples));
  if (!probes.empty()) {
    probes_ = std::make_unique<KeptProbes>();
    if (request.probes_show == "flat") {
      probes_->flat = std::make_unique<FlatProbes>(context_, shaders_, std::move(probes));
    } else {
      probes_->captures = std::make_unique<ProbeCaptures>(
          context_, shaders_, *scene_->gpu,
          ProbeCaptureInfo{
              .light_capacity = lights, .decal_capacity = decals, .brdf = parse_brdf(request.brdf), .shadows = shadows},
          std::move(probes));
    }
    renderer->light_probes(&probes_->set());
  }
  if (still_) renderer->light_still(still_->lists.get());
  if (shadows) renderer->cast_shadows(*shadows);
  if (mirror) renderer->mirror(*mirror);
  renderer_ = std::move(renderer);
  display_ = std::make_unique<Display>(context_.device(), shaders_, view.width(), view.height());
  renderer_key_ = std::move(key);
  lights_->brought = false;
  made_anew_ = true;
}

/// While time goes on, as many as the budget allows; the rest when it stands still, and before a picture is saved.
void Stage::renew_probes(const ViewState& state, const View& view, Captures which) {
  if (!probes_ || !probes_->captures) return;
  const Request& request = state.request;
  std::string now = fmt::format("{} {} {}", lights_->key, lights_->edits, frame_of(request));
  const bool first = probes_->seen.empty();
  const bool changed = probes_->seen != now;
  probes_->captures->renew(
      {.views = {&view, 1}, .lights = lights_->lights->all(), .decals = lights_->decals, .changed = changed},
      first || which == Captures::all ? ~0U : request.probe_budget);
  probes_->seen = std::move(now);
}

void Stage::need_frame(const ViewState& state, Captures which) {
  const Request& request = state.request;
  need_scene(request);
  const View view = requested_view(request, scene_->scene);
  need_lights(state);
  need_still(request, view);
  move_scene(request);
  std::string key = fmt::format("{}x{} {} {} {} {} {} {} {}", view.width(), view.height(), lights_->lights->size(),
                                lights_->decals.size(), request.depth_samples, request.depth,
                                shadows_key(request.shadows), reflections_key(request), static_cast<bool>(still_));
  if (key != renderer_key_) make_renderer(request, view, std::move(key));
  renderer_->light_still(still_ ? still_->lists.get() : nullptr);
  renew_probes(state, view, which);
  move_lights(view);
}

}  // namespace lamp::app
