// What stands for lights, what reflects, and lists in the world.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "render/mirror_pass.h"
#include "view/panels.h"

namespace lamp::app {
namespace {

const std::string OF_A_CAPTURE = "a capture has no meshes";

std::string words_of(const ShownProxies& proxies) {
  if (!proxies.refused.empty()) return proxies.refused;
  return fmt::format(
      "{} lights are drawn, {} of them cut to their shadow maps (green), {} around the eye (orange); {} are "
      "shown",
      proxies.drawn, proxies.cut, proxies.inside, proxies.shapes.size());
}

}  // namespace

void world_panel(PanelFrame& p) {
  if (!p.widgets.header("Proxies, probes, world", false)) return;
  Request& r = p.state.request;
  p.widgets.choose_word(
      "proxies", p.state.proxies, light_mark_names(),
      "Draws the meshes that a method rasterises in place of lights: none, those of the cell that you "
      "look into, or all.");
  if (p.state.proxies != LightMarks::none)
    Widgets::steady(3, [&] { Widgets::note(p.shown.proxies ? words_of(*p.shown.proxies) : ""); });
  p.widgets.slide("probes", r.probes, {.min = 0, .max = 1024, .logarithmic = true},
                  "Reflection probes: the scene's own first, then generated ones.",
                  p.shown.captured ? OF_A_CAPTURE : "");
  p.widgets.choose("probes show", r.probes_show, probes_show_names(),
                   "What each saw from its place, or a colour each, which shows how they are blended.");
  p.widgets.slide("probe budget", r.probe_budget, {.min = 0, .max = 64},
                  "Probes that are captured anew in a frame, while lights move.");
  p.widgets.check("probe boxes", p.state.probe_boxes,
                  "Draws the volumes of all reflection probes; those that weigh at the picked pixel are yellow.",
                  p.shown.probe_volumes.empty() ? "there are no probes" : "");
  Request with_mirror = r;
  with_mirror.mirror = std::max(r.mirror, 0.5F);
  p.widgets.slide("mirror", r.mirror, {}, "Surfaces less rough than this mirror what is around them; 0: none do.",
                  p.shown.captured ? OF_A_CAPTURE : why_refused(with_mirror));
  if (r.mirror > 0.0F)
    p.widgets.choose("mirror lists", r.mirror_lists, mirror_list_names(),
                     "What lights are looked up in where mirrored rays arrive.");
  Request moving = r;
  moving.moving = true;
  p.widgets.check("moving things", r.moving, "Small things of the scene move with the frames, as lights do.",
                  p.shown.captured ? OF_A_CAPTURE : why_refused(moving));
  p.widgets.check("world cells", p.state.world_cells,
                  "Draws the cells of the world around the picked point, and says what its list there holds, with "
                  "world-cells and world-tree; and likewise of what its mirrored ray meets.");
}

}  // namespace lamp::app
