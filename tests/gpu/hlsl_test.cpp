// Look-ups in HLSL against those in GLSL: the same cells, lights in the same order by every walk, and the same
// positions, bit for bit. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/method_check.h"
#include "gpu/odd_frames.h"
#include "gpu/over_depth.h"
#include "gpu/test_scenes.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t COUNT = 3 * ODD_LIGHTS;  // enough words of bits that scalar walks look for those with lights
constexpr std::uint32_t WORDS = 11;              // of a pixel, in walks.comp
constexpr std::string_view PREFIX = "walks.hlsl@";

struct Case {
  std::string_view lookup;
  std::string_view method;
  std::vector<std::string> settings;
  std::uint32_t max_loop_rounds = ~0U;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.method << " " << fmt::format("{}", fmt::join(c.settings, " "));
}

/// Every look-up, and what those of lists walk where lists do not fit.
std::vector<Case> cases() {
  return {{"all", "all", {}},
          {"tile_lists", "tiled", {"bounds=half"}},
          {"tile_lists", "tiled", {"capacity=8"}},
          {"tile_lists_scalar", "tiled", {"walk=scalar-cell"}},
          {"tile_typed", "tiled", {"order=type"}},
          {"tile_typed", "tiled", {"order=type", "mean_capacity=8"}},
          {"tile_bits", "tiled-bits", {}},
          {"tile_bits_scalar", "tiled-bits", {"walk=scalar-entity"}},
          {"tile_zbins", "drobot-zbin", {"walk=plain"}},
          {"tile_zbins_scalar", "drobot-zbin", {"walk=scalar-entity"}},
          {"cluster_lists", "clustered", {}},
          {"cluster_lists", "clustered", {"mean_capacity=1"}},
          {"cluster_lists_scalar", "clustered", {"walk=scalar-cell"}},
          {"cluster_bits", "clustered", {"container=bits"}},
          {"cluster_bits_scalar", "clustered", {"container=bits", "walk=scalar-entity"}},
          {"cell_lists", "lamplight", {"container=list", "tile=8"}},
          {"cell_lists", "lamplight", {"container=list", "depth=none"}},
          {"cell_lists", "lamplight", {"container=list", "mean_cells=1", "mean_capacity=1"}},
          {"cell_bits", "lamplight", {"container=bits", "tile=8"}},
          {"cell_bits", "lamplight", {"container=bits", "depth=none"}},
          {"cell_lists_stepped", "lamplight", {"container=list", "cells=list"}, COUNT},
          {"cell_bits_stepped", "lamplight", {"container=bits", "cells=list"}, COUNT}};
}

std::vector<shared::Light> thrice(const std::vector<Light>& lights) {
  std::vector<Light> all;
  for (int i = 0; i < 3; ++i) all.insert(all.end(), lights.begin(), lights.end());
  return pack(all);
}

/// An orthographic view whose lines of sight lean, and one in perspective.
std::vector<OverDepth>& frames() {
  static std::vector<OverDepth> made;
  if (!made.empty()) return made;
  at_context_end([] { made.clear(); });
  for (const OddFrame& odd : odd_frames())
    if (odd.name == "leaning, behind the eye" || odd.name == "larger")
      made.emplace_back(odd.view, odd.depth, thrice(odd.lights));
  return made;
}

vulkan::PlanRunner make_runner(const Case& c) {
  const Method& method = *take(find_method(c.method));
  DeviceTraits traits = test_context().device().traits;
  traits.max_loop_rounds = c.max_loop_rounds;
  Plan plan = take(make_plan(method, {.width = ODD_SIZE.x,
                                      .height = ODD_SIZE.y,
                                      .light_capacity = COUNT,
                                      .options = take(resolve_options(method, c.settings)),
                                      .traits = traits}));
  EXPECT_EQ(plan.lookup.name, c.lookup);
  return take(vulkan::PlanRunner::create(test_context().device(), std::move(plan), shader_library().source()));
}

class Hlsl : public GpuTest, public ::testing::WithParamInterface<Case> {};

TEST_P(Hlsl, WalksAsGlslDoes) {
  vulkan::PlanRunner runner = make_runner(GetParam());
  ASSERT_EQ(frames().size(), 2);
  for (OverDepth& frame : frames()) {
    const auto words = frame.per_pixel({"walks", "walks.hlsl"}, runner, Passes::separate, WORDS);
    const std::vector<std::uint32_t>& glsl = words[0];
    const std::vector<std::uint32_t>& hlsl = words[1];
    const std::size_t at = std::ranges::mismatch(glsl, hlsl).in1 - glsl.begin();
    EXPECT_EQ(at, glsl.size()) << "pixel " << at / WORDS << ", word " << at % WORDS << " of walks.comp";
    EXPECT_TRUE(std::ranges::any_of(glsl, [](std::uint32_t word) { return word != 0; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Hlsl, ::testing::ValuesIn(cases()), [](const auto& test) {
  return test_name(fmt::format("{}_{}", test.param.lookup, test.index));
});

TEST(HlslCases, HaveEveryLookUp) {
  std::uint32_t lookups = 0;
  for (const ShaderCode& code : test_shaders()) {
    if (!code.name.starts_with(PREFIX)) continue;
    ++lookups;
    EXPECT_TRUE(std::ranges::count(cases(), code.name.substr(PREFIX.size()), &Case::lookup)) << code.name;
  }
  EXPECT_GE(lookups, 16);
}

}  // namespace
}  // namespace lamp::app
