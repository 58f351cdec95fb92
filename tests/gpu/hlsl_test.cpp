// Look-ups in HLSL against those in GLSL: the same cells, lights in the same order by every walk, and the same
// positions, bit for bit.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/lookup_cases.h"
#include "gpu/method_check.h"
#include "gpu/over_depth.h"
#include "gpu/test_scenes.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

constexpr std::uint32_t WORDS = 11;  // of a pixel, in walks.comp
constexpr std::string_view PREFIX = "walks.hlsl@";

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

vulkan::PlanRunner make_runner(const LookUpCase& c) {
  Plan plan = take(make_plan(*take(find_method(c.method)), problem_of(c, ODD_SIZE)));
  EXPECT_EQ(plan.lookup.name, c.lookup);
  return take(vulkan::PlanRunner::create(test_context().device(), std::move(plan), shader_library().source()));
}

class Hlsl : public GpuTest, public ::testing::WithParamInterface<LookUpCase> {};

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

INSTANTIATE_TEST_SUITE_P(Of, Hlsl, ::testing::ValuesIn(lookup_cases()), [](const auto& test) {
  return test_name(fmt::format("{}_{}", test.param.lookup, test.index));
});

TEST(HlslCases, HaveEveryLookUp) {
  std::uint32_t lookups = 0;
  for (const ShaderCode& code : test_shaders()) {
    if (!code.name.starts_with(PREFIX)) continue;
    ++lookups;
    EXPECT_TRUE(std::ranges::count(lookup_cases(), code.name.substr(PREFIX.size()), &LookUpCase::lookup)) << code.name;
  }
  EXPECT_GE(lookups, 16);
}

}  // namespace
}  // namespace lamp::app
