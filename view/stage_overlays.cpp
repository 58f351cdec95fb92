// What overlays need besides the walks of one method: the other method's, the pictures of both, the shadow atlas.
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/judgement.h"
#include "render/pass_uses.h"
#include "render/shadow_heat.h"
#include "render/slice_walk.h"
#include "view/depth_bins.h"
#include "view/shadow_overlay.h"
#include "view/stage.h"

namespace lamp::app {

std::vector<Visit> Stage::visits_of_other(const Overlaying& o) {
  const Request& r = o.state.request;
  const Against& against = *o.state.against;
  const Chosen other = o.second ? lighting(r, r.method, r.options) : lighting(r, against.method, against.options);
  return renderer_->visit_all(other.lighting);
}

Overlaid Stage::shadow_overlay(const Overlaying& o) {
  const ViewState& state = o.state;
  if (state.overlay != Overlay::shadow_atlas) {
    const ShadowHeat of = state.overlay == Overlay::shadow_age ? ShadowHeat::age : ShadowHeat::size;
    return make_shadow_heat(state.overlay, state.palette, shadow_heat(*renderer_, o.lighting, of), o.scale_max);
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
  return make_shadow_overlay(state.palette, {.texels = texels,
                                             .side = side,
                                             .maps = shadows.maps(),
                                             .light = state.light,
                                             .picture = {renderer_->view().width(), renderer_->view().height()}});
}

Overlaid Stage::slice_overlay(const Overlaying& o) {
  if (!o.lighting.runner().plan().any_depth) {
    const std::string refused = fmt::format(
        "{} lists lights for the depths of surfaces alone: a slice through the air needs a method that is right at any "
        "depth, such as clustered",
        o.lighting.info().method->name);
    return {.pixels = std::vector<std::uint32_t>(visits_.size()),
            .legend = {.overlay = Overlay::slice, .refused = refused}};
  }
  depth_ = renderer_->read_depth();
  const std::vector<Visit> visits = visit_at(*renderer_, o.lighting, o.state.slice_m);
  return make_slice(o.state.palette,
                    {.view = renderer_->view(), .visits = visits, .depth = depth_, .scale_max = o.scale_max},
                    o.state.slice_m);
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
