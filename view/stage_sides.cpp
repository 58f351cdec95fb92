// The two sides of a picture: each lit by a method of its own, with room made for its lists, and an overlay over it.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>

#include "commands/pictures.h"
#include "commands/still_stats.h"
#include "render/verification.h"
#include "view/panels.h"
#include "view/stage_kept.h"

namespace lamp::app {
namespace {

bool can_be_laid_over(const ViewState& state) {
  if (state.overlay == Overlay::difference) return state.against.has_value();
  if (is_of_shadows(state.overlay)) return requested_shadows(state.request).has_value();
  return state.overlay != Overlay::none;
}

}  // namespace

ShownSide Stage::side(const ViewState& state, const Chosen& chosen, Rendered rendered) {
  ShownSide made{.stats = make_stats({.device = context_.row(),
                                      .scene = state.request.scene,
                                      .view = renderer_->view(),
                                      .lights = lights_->lights->size(),
                                      .frames = 1,
                                      .decals = lights_->decals.size(),
                                      .probes = renderer_->probes().probes().size()},
                                     chosen.lighting, std::move(rendered)),
                 .by_auto = chosen.by_auto,
                 .legend = {}};
  const Plan& plan = chosen.lighting.runner().plan();
  const OwnTests own = own_tests(plan, chosen.lighting.info().options);
  made.any_depth = plan.any_depth;
  made.rasterises = std::ranges::find(plan.buffers, "light proxies", &BufferDesc::name) != plan.buffers.end();
  made.keeps_masks = (own.passes & gpu::PASSES_MASK) != 0;
  made.stats.clock = clock_.read();
  made.stats.shadows = shadow_stats(renderer_->shadows());
  made.stats.mirror = mirror_stats(renderer_->mirrored());
  if (probes_ && probes_->captures) made.stats.captures = probes_->captures->counts();
  if (still_) made.stats.still = still_stats(still_->made);
  return made;
}

std::vector<Visit> Stage::checked_visits(Lighting& lighting) {
  const View& view = renderer_->view();
  std::vector<Visit> visits;
  for_each_truth({.view = view, .depth = depth_, .lights = listed_lights(), .rows = view.height()},
                 [&](const Truth& truth) {
                   const std::vector<Visit> band = renderer_->visit(lighting, truth);
                   visits.insert(visits.end(), band.begin(), band.end());
                 });
  add_still_misses(visits);
  return visits;
}

Legend Stage::lay_over(const Overlaying& o) {
  const View& view = renderer_->view();
  const Overlay overlay = o.state.overlay;
  if (overlay == Overlay::depth_range || overlay == Overlay::missed) depth_ = renderer_->read_depth();
  visits_ = overlay == Overlay::missed ? checked_visits(o.lighting) : renderer_->visit_all(o.lighting);
  const Overlaid made = overlaid(o);
  const std::span<std::uint32_t> to = display_->overlay();
  for (std::uint32_t y = 0; y < view.height(); ++y)
    for (std::uint32_t x = o.first_x; x < std::min(o.end_x, view.width()); ++x)
      to[x + std::size_t{view.width()} * y] = made.pixels[x + std::size_t{view.width()} * y];
  return made.legend;
}

bool Stage::grow(KeptLighting& kept) {
  bring_lights();
  const bool grew = make_room(*renderer_, shaders_, kept.lighting, kept.asked);
  made_anew_ = made_anew_ || grew;
  return grew;
}

std::uint32_t Stage::divider_x(const ViewState& state) const {
  const float divider = state.against ? state.against->divider : 1.0F;
  return static_cast<std::uint32_t>(std::lround(divider * static_cast<float>(renderer_->view().width())));
}

std::pair<ShownSide, Lighting*> Stage::draw_side(const ViewState& state, const SideOf& of, Shown& shown) {
  const Chosen chosen = lighting(state.request, of.method, of.options);
  KeptLighting& kept = lightings_.front();
  const std::optional<float> exposure = parse_exposure(state.exposure);
  const auto draw = [&] {
    Rendered rendered = renderer_->draw(kept.lighting, [&](vulkan::Recorder& recorder) {
      if (!of.second && !exposure) display_->record_sums(recorder, renderer_->targets());
    });
    return side(state, chosen, std::move(rendered));
  };
  ShownSide made = draw();
  if (state.request.grow && overflowed_cells(made.stats) != 0 && !kept.full) {  // for other lights than it grew for
    kept.full = !grow(kept);
    if (!kept.full) made = draw();
  }
  made.full = kept.full;
  if (!of.second) shown.exposure = exposure ? *exposure : display_->exposure();
  const bool overlaid = can_be_laid_over(state);
  if (overlaid)
    made.legend = lay_over({.state = state,
                            .lighting = kept.lighting,
                            .second = of.second,
                            .overflowed = made.stats.rendered.counters.overflowed_cells != 0,
                            .scale_least = of.scale_least,
                            .first_x = of.first_x,
                            .end_x = of.end_x});
  else if (state.list_lengths)
    visits_ = renderer_->visit_all(kept.lighting);
  if (!overlaid && state.overlay != Overlay::none)
    made.legend = {.overlay = state.overlay, .refused = why_no_overlay(state.overlay, state, shown)};
  if (overlaid || state.list_lengths) {
    set_walked(made.stats, visits_);
    if (made.stats.shadows) made.stats.shadows->leaks = made.legend.leaks;
    made.lengths = list_lengths(visits_);
    if (state.overlay == Overlay::cells)
      made.cells = cell_places(visits_, {renderer_->view().width(), of.first_x, of.end_x});
  }
  renderer_->also([&](vulkan::Recorder& recorder) {
    display_->record(recorder, renderer_->targets(),
                     {.exposure = shown.exposure, .first_x = of.first_x, .end_x = of.end_x, .overlaid = overlaid});
  });
  return {std::move(made), &kept.lighting};
}

std::pair<Lighting*, Lighting*> Stage::draw_sides(const ViewState& state, Shown& shown) {
  const Request& r = state.request;
  SideOf first{.method = r.method, .options = r.options, .end_x = divider_x(state)};
  Lighting* lit = nullptr;
  std::tie(shown.first, lit) = draw_side(state, first, shown);
  if (!state.against) return {lit, nullptr};
  const Legend& legend = shown.first.legend;
  auto [second, second_lit] = draw_side(state,
                                        {.method = state.against->method,
                                         .options = state.against->options,
                                         .second = true,
                                         .first_x = first.end_x,
                                         .end_x = renderer_->view().width(),
                                         .scale_least = legend.high},
                                        shown);
  shown.second = std::move(second);
  // One scale for both: the first side once more where the second reaches beyond its own.
  first.scale_least = shown.second->legend.high;
  if (legend.refused.empty() && first.scale_least > legend.high) shown.first = draw_side(state, first, shown).first;
  return {lit, second_lit};
}

}  // namespace lamp::app
