// What overlays need besides the walks of one method: the other method's, the pictures of both, the shadow atlas.
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>

#include "gpu/transfer.h"
#include "render/cell_masks.h"
#include "render/judgement.h"
#include "render/pass_uses.h"
#include "render/pixel_lights.h"
#include "render/shadow_heat.h"
#include "render/shadow_leaks.h"
#include "render/slice_walk.h"
#include "view/depth_bins.h"
#include "view/light_cells.h"
#include "view/mask_overlay.h"
#include "view/shadow_overlay.h"
#include "view/stage_kept.h"

namespace lamp::app {

std::vector<Visit> Stage::visits_of_other(const Overlaying& o) {
  const Request& r = o.state.request;
  const Against& against = *o.state.against;
  const Chosen other = o.second ? lighting(r, r.method, r.options) : lighting(r, against.method, against.options);
  return renderer_->visit_all(other.lighting);
}

Overlaid Stage::shadow_overlay(const Overlaying& o) {
  const ViewState& state = o.state;
  if (state.overlay == Overlay::shadow_leaks) return leaks_overlay(o);
  if (state.overlay != Overlay::shadow_atlas) {
    const ShadowHeat of = state.overlay == Overlay::shadow_age ? ShadowHeat::age : ShadowHeat::size;
    return make_shadow_heat(state.overlay, state.palette, shadow_heat(*renderer_, o.lighting, of), o.scale_least);
  }
  const Shadows& shadows = *renderer_->shadows();
  const std::uint32_t side = shadows.settings().atlas_size;
  const std::size_t count = std::size_t{side} * side;
  const vulkan::Buffer buffer = readback_buffer(context_.device(), "shadow atlas read-back", count * sizeof(float));
  renderer_->also([&](vulkan::Recorder& recorder) {
    record_copy(recorder, shadows.atlas(), buffer);
    recorder.barrier({host_reads(vulkan::Resource::storage(buffer.handle()))});
  });
  renderer_->forget(buffer);
  const std::vector<float> texels = first_values<float>(buffer, count);
  std::optional<std::uint32_t> record;
  if (state.light) record = renderer_->record_of(*state.light);
  return make_shadow_overlay(state.palette, {.texels = texels,
                                             .side = side,
                                             .maps = shadows.maps(),
                                             .record = record,
                                             .picture = {renderer_->view().width(), renderer_->view().height()}});
}

Overlaid Stage::leaks_overlay(const Overlaying& o) {
  if (std::string why = why_no_leaks(*renderer_, o.lighting, scene_->scene); !why.empty())
    return refused_overlay(Overlay::shadow_leaks, visits_.size(), std::move(why));
  return make_shadow_leaks(o.state.palette,
                           shadow_leaks(*renderer_, o.lighting, scene_->rays.of(context_, *scene_->gpu, *renderer_)));
}

Overlaid Stage::slice_overlay(const Overlaying& o) {
  if (!o.lighting.runner().plan().any_depth)
    return refused_overlay(Overlay::slice, visits_.size(),
                           fmt::format("{} lists lights for the depths of surfaces alone: a slice through the air "
                                       "needs a method that is right at any depth, such as clustered",
                                       o.lighting.info().method->name));
  depth_ = renderer_->read_depth();
  const std::vector<Visit> visits = visit_at(*renderer_, o.lighting, o.state.slice_m);
  return make_slice(o.state.palette,
                    {.view = renderer_->view(), .visits = visits, .depth = depth_, .scale_least = o.scale_least},
                    o.state.slice_m);
}

Overlaid Stage::light_cells_overlay(const Overlaying& o) {
  const auto refused = [&](std::string why) {
    return refused_overlay(Overlay::light_cells, visits_.size(), std::move(why));
  };
  const std::span<const shared::Light> lights = lights_->lights->all();
  if (!o.state.light) return refused(NO_LIGHT);
  const std::uint32_t light = *o.state.light;
  if (light >= lights.size())
    return refused(fmt::format("there is no light {}: the frame has {}", light, lights.size()));
  if (light >= listed_count())
    return refused(
        fmt::format("light {} stands still: it is in lists of its own, which have no cells of the picture", light));
  const View& view = renderer_->view();
  depth_ = renderer_->read_depth();
  std::vector<Reach> reached(visits_.size(), Reach::outside);
  for (std::uint32_t i = 0; i < reached.size(); ++i)
    if (visits_[i].cell != gpu::SKY_CELL)
      reached[i] = reach(lights[light], view.world_position(i % view.width(), i / view.width(), depth_[i]));
  return make_light_cells({.width = view.width(),
                           .visits = visits_,
                           .listed = pixels_with(*renderer_, o.lighting, light),
                           .reached = reached});
}

Overlaid Stage::mask_overlay(const Overlaying& o) {
  const NumberedCells cells = numbered_cells(visits_);
  return make_mask_overlay(o.state.palette, cells.of_pixels, cell_masks(*renderer_, cells.of_pixels, cells.count),
                           o.scale_least);
}

Overlaid Stage::walk_overlay(const Overlaying& o) {
  const Overlay overlay = o.state.overlay;
  const bool with_still = still_ && overlay == Overlay::heat;
  std::vector<Visit> walked;
  if (with_still) {
    walked = visits_;
    add_still_walks(walked);
  }
  const std::vector<Visit> other = overlay == Overlay::difference ? visits_of_other(o) : std::vector<Visit>();
  return make_overlay(overlay, o.state.palette,
                      {.view = renderer_->view(),
                       .visits = o.second && !other.empty() ? other
                                 : with_still               ? walked
                                                            : visits_,
                       .depth = depth_,
                       .other = o.second ? visits_ : other,
                       .lights = static_cast<std::uint32_t>(listed_count()),
                       .overflowed = o.overflowed,
                       .scale_least = o.scale_least});
}

Overlaid Stage::overlaid(const Overlaying& o) {
  if (is_of_shadows(o.state.overlay)) return shadow_overlay(o);
  if (o.state.overlay == Overlay::slice) return slice_overlay(o);
  if (o.state.overlay == Overlay::light_cells) return light_cells_overlay(o);
  if (o.state.overlay == Overlay::mask) return mask_overlay(o);
  return walk_overlay(o);
}

std::vector<std::uint32_t> Stage::read_words(VkBuffer buffer, std::size_t count, std::size_t first) {
  const vulkan::Buffer read = readback_buffer(context_.device(), "words of a method", count * sizeof(std::uint32_t));
  renderer_->also([&](vulkan::Recorder& recorder) {
    recorder.barrier(
        {copies_from(vulkan::Resource::storage(buffer)), copies_to(vulkan::Resource::storage(read.handle()))});
    const VkBufferCopy part{.srcOffset = first * sizeof(std::uint32_t), .size = count * sizeof(std::uint32_t)};
    vkCmdCopyBuffer(recorder.commands(), buffer, read.handle(), 1, &part);
    recorder.barrier({host_reads(vulkan::Resource::storage(read.handle()))});
  });
  renderer_->forget(read);
  return first_values<std::uint32_t>(read, count);
}

std::optional<DepthBins> Stage::read_bins(const Lighting& lighting) {
  const Plan& plan = lighting.runner().plan();
  const auto bins = std::ranges::find(plan.buffers, "bins", &BufferDesc::name);
  if (bins == plan.buffers.end() || !plan.lookup.name.starts_with("tile_zbins")) return std::nullopt;
  const auto id = PLAN_BUFFER + static_cast<ResourceId>(bins - plan.buffers.begin());
  const std::uint64_t count = lighting.info().options.integer("bins");
  const std::size_t words = bins->bytes / sizeof(std::uint32_t);
  const std::uint64_t tiles = plan.cells / count;
  const shared::Frame& frame = renderer_->data().host_frame();
  DepthBins read{.bins = decode_bins(read_words(lighting.runner().buffer(id), words), words == 2 * count),
                 .lights = frame.light_count,
                 .width = renderer_->view().width()};
  read.of_pixels.reserve(visits_.size());
  for (const Visit& visit : visits_)
    read.of_pixels.push_back(visit.cell == gpu::SKY_CELL ? ~0U : static_cast<std::uint32_t>(visit.cell / tiles));
  return read;
}

void Stage::add_findings(const ViewState& state, Lighting& lighting, Shown& shown) {
  if (state.depth_bins) {
    visits_ = renderer_->visit_all(lighting);
    shown.bins = read_bins(lighting);
  }
  if (state.proxies != LightMarks::none) shown.proxies = read_proxies(state, lighting, shown);
  shown.shadow = read_shadow(state);
  shown.probe_volumes = boxes_of(renderer_->probes().probes());
  if (state.world_cells && shown.inspection && !shown.inspection->sky)
    shown.world = read_world(lighting, *shown.inspection);
}

float Stage::picture_difference(const ViewState& state) {
  const Request& r = state.request;
  const HdrImage first = renderer_->relight(lighting(r, r.method, r.options).lighting).image;
  const Against& against = *state.against;
  return max_abs_difference(first, renderer_->relight(lighting(r, against.method, against.options).lighting).image);
}

}  // namespace lamp::app
