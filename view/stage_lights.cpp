// Lights of a state: made once, moved on the GPU from frame to frame.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "view/stage_kept.h"

namespace lamp::app {
namespace {

/// What generated lights, wherever they are on their paths, and decals follow from.
std::string lights_key(const Request& r) {
  return fmt::format("{} {} {} {} {} {} {} {}", r.lights, r.lights_given, r.spots, r.still, r.range, r.seed, r.decals,
                     generated_first(r));
}

}  // namespace

void Stage::need_lights(const ViewState& state) {
  const Request& request = state.request;
  const Scene& scene = scene_->scene;
  check_scene_lights(request, scene);
  std::string key = lights_key(request);
  if (!lights_ || lights_->key != key) {
    auto lights = std::make_unique<KeptLights>();
    at_rest();  // where lights, decals and probes are placed
    const bool generates = request.lights != 0 && (!scene.captured || request.lights_given);
    if (generates && !scene_->air) scene_->air = find_open_air(scene);
    lights->made = requested_moving_lights(request, scene, generates ? &*scene_->air : nullptr);
    lights->decals = requested_decals(request, scene);
    lights->key = std::move(key);
    lights_ = std::move(lights);
  }
  std::string edits = to_json(state).at("edits").dump();
  if (!lights_->moving || lights_->edits != edits) {
    auto moving = std::make_shared<MovingLights>(lights_->made);
    apply_edits(state, *moving);
    lights_->moving = std::move(moving);
    lights_->edits = std::move(edits);
    lights_->mover.reset();
    lights_->brought = false;
    lights_->lights.reset();
  }
  const PathTime time = requested_time(request, scene);
  if (lights_->lights && time == lights_->time) return;
  lights_->time = time;
  lights_->lights = std::make_shared<FrameLights>(lights_->moving, time);
}

void Stage::at_rest() {
  if (scene_->setup.at_rest.empty()) return;
  scene_->scene.instances = scene_->setup.at_rest;
  scene_->moved_to = -1;
}

void Stage::bring_lights() { renderer_->set_frame(View(renderer_->view()), lights_->lights->all(), lights_->decals); }

/// The renderer's lights are moved where it has them, from the second frame on; where shadows are drawn on the CPU's
/// word, all are brought from here.
void Stage::move_lights(const View& view) {
  const bool on_gpu = renderer_->shadows() == nullptr && !still_ && renderer_->mirrored() == nullptr && !probes_ &&
                      !renderer_->depth().several();
  if (!on_gpu || !lights_->brought) renderer_->set_frame(view, lights_->lights->all(), lights_->decals);
  lights_->brought = true;
  if (!on_gpu) return;
  if (!lights_->mover)
    lights_->mover = std::make_unique<LightMover>(context_, shaders_, lights_->moving->lights, lights_->moving->paths,
                                                  lights_->moving->first);
  renderer_->move_frame(view, *lights_->mover, lights_->time);
}

/// Host passes and trees see the lights that were brought.
bool Stage::needs_lights_here(const Lighting& lighting) {
  const Plan& plan = lighting.runner().plan();
  const auto on_host = [](const Pass& pass) { return pass.kind == PassKind::host; };
  return plan.binds(INPUT_STILL) || std::ranges::any_of(plan.passes, on_host) ||
         (plan.fused && std::ranges::any_of(plan.fused->passes, on_host));
}

}  // namespace lamp::app
