// A row for each family of shaders that cull.
// SPDX-License-Identifier: Apache-2.0
#include "view/own_tests.h"

#include <algorithm>
#include <array>

#include "render/shaders/explain_data.h"

namespace lamp::app {
namespace {

using gpu::PASSES_BOX;
using gpu::PASSES_CONE;
using gpu::PASSES_DEPTHS;
using gpu::PASSES_EXACT;
using gpu::PASSES_MASK;
using gpu::PASSES_SIDES;

/// Tiled culling: its axes say.
std::uint32_t tests_of_tiles(const Options& options) {
  std::uint32_t passes = 0;
  const std::string& test = options.word("test");
  if (test == "planes" || test == "planes+aabb") passes |= PASSES_SIDES;
  if (test == "aabb" || test == "planes+aabb") passes |= PASSES_BOX;
  if (test == "exact") passes |= PASSES_EXACT;
  const std::string& bounds = options.word("bounds");
  if (bounds != "none") passes |= PASSES_DEPTHS;
  if (bounds == "mask") passes |= PASSES_MASK;
  if (options.word("spot") != "sphere") passes |= PASSES_CONE;
  return passes;
}

std::uint32_t tests_of_lamplight(const Options& options) {
  const std::uint32_t of_depth = options.word("depth") == "none" ? 0U : PASSES_MASK;
  return PASSES_SIDES | PASSES_DEPTHS | PASSES_EXACT | PASSES_CONE | of_depth;
}

struct Family {
  std::string_view shaders;  ///< that they begin with
  OwnTests (*tests)(const Options& options);
};

constexpr std::array<Family, 6> FAMILIES{
    {{"methods/clustered_", [](const Options&) { return OwnTests{PASSES_SIDES | PASSES_DEPTHS | PASSES_BOX, {}}; }},
     {"methods/zbin_", [](const Options&) { return OwnTests{PASSES_SIDES | PASSES_DEPTHS, {}}; }},
     {"methods/lamplight_", [](const Options& options) { return OwnTests{tests_of_lamplight(options), {}}; }},
     {"methods/raster_", [](const Options&) { return OwnTests{0, "its mesh covers the cell"}; }},
     {"methods/world_", [](const Options&) { return OwnTests{0, "its cube of the world"}; }},
     {"methods/tile_", [](const Options& options) { return OwnTests{tests_of_tiles(options), {}}; }}}};

}  // namespace

OwnTests own_tests(const Plan& plan, const Options& options) {
  for (const Family& family : FAMILIES)
    if (std::ranges::any_of(plan.passes, [&](const Pass& pass) { return pass.shader.starts_with(family.shaders); }))
      return family.tests(options);
  return {.passes = 0, .otherwise = plan.binds(INPUT_STILL) ? "its cell of the tree" : "untested"};
}

}  // namespace lamp::app
