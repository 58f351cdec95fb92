// What overlays need besides the walks of one method: the other method's, the pictures of both, the shadow atlas.
// SPDX-License-Identifier: Apache-2.0

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/judgement.h"
#include "render/pass_uses.h"
#include "render/shadow_heat.h"
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

float Stage::picture_difference(const ViewState& state) {
  const Request& r = state.request;
  const HdrImage first = renderer_->relight(lighting(r, r.method, r.options).lighting).image;
  const Against& against = *state.against;
  return max_abs_difference(first, renderer_->relight(lighting(r, against.method, against.options).lighting).image);
}

}  // namespace lamp::app
