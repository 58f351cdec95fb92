// The world tree: lights that stand still, listed ahead for any point of the world. The plan has no passes: all that a
// frame needs is in a buffer that the host brings (INPUT_STILL), which WorldTree makes and follows changes with.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering (2017), bonus slides.
// Promise: no work in the frame; lists ascend; no camera.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/world_tree.h"

#include "methods.h"

namespace lamp {
namespace {

constexpr std::uint32_t MOST_MIB = 4096;  // places have 30 bits

Plan plan_world_tree(const Problem&) {
  Plan plan;
  plan.any_depth = true;
  plan.lookup = {.name = "world_tree", .bindings = {{INPUT_FRAME}, {INPUT_STILL}}};
  return plan;
}

}  // namespace

void set_options(WorldTreeInfo& info, const Options& options) {
  info.budget = std::uint64_t{options.integer("budget")} << 20;
  info.detail = options.integer("detail");
  info.texels = options.integer("texels");
  if (options.word("occlusion") == "none") info.occluders.reset();
}

Method world_tree_method() {
  return {.name = "world-tree",
          .title = "World tree: still lights at any point, made ahead",
          .source = "Drobot, Improved Culling for Tiled and Clustered Rendering (2017), bonus slides",
          .summary = "Lights that stand still, listed ahead in a tree over the world; if asked, where they are seen.",
          .result = "world_tree",
          .needs_depth = false,
          .any_depth = true,
          .any_point = true,
          .still = true,
          .options = {{.key = "budget",
                       .help = "MiB of lists and tree; what does not fit is kept coarser",
                       .fallback = "64",
                       .min = 1,
                       .max = MOST_MIB},
                      {.key = "detail",
                       .help = "cells in a light's range, at most; more waste less, and take memory and time to build",
                       .fallback = "16",
                       .min = 1,
                       .max = 64},
                      {.key = "texels",
                       .help = "directions in which a light looks around: texels along a side of a cube's face",
                       .fallback = "32",
                       .min = 1,
                       .max = 1024},
                      {.key = "occlusion",
                       .help = "ahead: a light is left out where still geometry surely hides it, for pictures with "
                               "shadows; none: it is not",
                       .fallback = "none",
                       .choices = {"none", "ahead"}}},
          .plan = plan_world_tree};
}

}  // namespace lamp
