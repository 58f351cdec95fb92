// Lists of lights that stand still: made for a state's lights, kept while these and their margin are the same.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "render/scene_occluders.h"
#include "render/still_tree.h"
#include "view/stage_kept.h"

namespace lamp::app {

std::size_t Stage::still_count(const Request& request) const {
  if (request.still_lists == "off") return 0;
  return still_lights(request, scene_->scene, lights_->made.paths.size());
}

void Stage::need_still(const Request& request, const View& view) {
  if (request.still_lists == "off") {
    still_.reset();
    return;
  }
  const Scene& scene = scene_->scene;
  if (!scene_->bounds) scene_->bounds = bounds(scene);
  const float margin = still_margin(request, *scene_->bounds, {&view, 1}, context_.device().traits);
  const bool painted = !lights_->decals.empty();
  std::string key =
      fmt::format("{} {} {} {} {}", request.still_lists, request.still_occlusion, request.still_bytes, margin, painted);
  const std::span<const shared::Light> standing = std::span(lights_->moving->lights).last(still_count(request));
  if (still_ && still_->key == key && (still_->of == lights_->moving || are_same(still_->lights, standing))) {
    still_->of = lights_->moving;
    return;
  }
  auto still = std::make_unique<KeptStill>();
  still->lights.assign(standing.begin(), standing.end());
  still->made = make_still(request, {.scene = scene, .margin_m = margin, .lights = still->lights, .painted = painted});
  still->lists = std::make_unique<StillLists>(context_, still->made.kind(), static_cast<std::uint32_t>(standing.size()),
                                              still->made.words());
  if (request.still_occlusion != 0) still->occluders = scene_occluders(scene);
  still->of = lights_->moving;
  still->key = std::move(key);
  if (renderer_ && still_) {
    renderer_->light_still(nullptr);
    renderer_->forget(still_->lists->buffer());
  }
  still_ = std::move(still);
  made_anew_ = true;
}

std::size_t Stage::listed_count() const { return lights_->lights->size() - (still_ ? still_->lights.size() : 0); }

std::span<const shared::Light> Stage::listed_lights() const {
  return std::span(lights_->lights->all()).first(listed_count());
}

std::optional<StillPixels> Stage::still_pixels(std::span<const float> depth) {
  if (!still_) return std::nullopt;
  StillPixels at{.context = context_,
                 .shaders = shaders_,
                 .made = still_->made,
                 .on_gpu = *still_->lists,
                 .lights = still_->lights,
                 .first = static_cast<std::uint32_t>(listed_count()),
                 .occluders = still_->occluders ? &*still_->occluders : nullptr,
                 .points = {}};
  if (!still_->made.tree) {
    at.points = pixel_points(*renderer_);
    return at;
  }
  const View& view = renderer_->view();
  at.points.reserve(depth.size());
  for (std::uint32_t i = 0; i < depth.size(); ++i)
    at.points.push_back({.position = Vec3(DVec3(view.world_position(i % view.width(), i / view.width(), depth[i]))),
                         .triangle = NO_TRIANGLE});
  return at;
}

void Stage::add_still_walks(std::vector<Visit>& visits) {
  depth_ = renderer_->read_depth();
  const std::optional<StillPixels> at = still_pixels(depth_);
  for (std::size_t i = 0; i < visits.size(); ++i)
    if (visits[i].cell != gpu::SKY_CELL) visits[i].visited += static_cast<std::uint32_t>(at->lights_at(i).size());
}

/// All at once; pixel by pixel only where something is missed, which is a fault.
void Stage::add_still_misses(std::vector<Visit>& visits) {
  if (!still_) return;
  const std::optional<StillPixels> at = still_pixels(depth_);
  const std::size_t width = renderer_->view().width();
  for (std::size_t row = 0; row < visits.size(); row += width) {
    std::vector<std::size_t> pixels;
    for (std::size_t i = row; i < row + width; ++i)
      if (visits[i].cell != gpu::SKY_CELL) pixels.push_back(i);
    if (at->check(pixels).missed == 0) continue;
    for (const std::size_t i : pixels) visits[i].missed += static_cast<std::uint32_t>(at->check({&i, 1}).missed);
  }
}

}  // namespace lamp::app
