// Radial bounds against the look-up: what a look-up finds lit at all is within the bound, for any depths, normals and
// seeds; and bounds cut what lies in shadow.
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "gpu/lit_lights.h"

namespace lamp::app {
namespace {

using shared::ShadowCase;

using Words = std::array<std::uint32_t, sizeof(shared::RadialBound) / sizeof(std::uint32_t)>;

std::vector<Words> bounds_in(const vulkan::Buffer& buffer, std::size_t count) {
  const VkBufferCopy all{.size = count * sizeof(shared::RadialBound)};
  const vulkan::Buffer copy = host_buffer("bounds", all.size);
  test_context().submit(
      [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, buffer.handle(), copy.handle(), 1, &all); });
  return contents<Words>(copy);
}

class ShadowRadialBounds : public GpuTest, public ::testing::WithParamInterface<ShadowFilter> {};

TEST_P(ShadowRadialBounds, HoldEverythingThatIsLit) {
  test::Random random(5);
  const LitLights lit = some_lit_lights(GetParam());
  const auto count = static_cast<std::uint32_t>(lit.lights.size());
  const std::vector<ShadowCase> cases = some_lit_cases(lit, random);
  const GpuImage atlas = depth_image(LIT_ATLAS, LIT_ATLAS, some_wall_depths(random));
  const ShadowReach radial = reach_of(ShadowReach::Kind::radial, lit, atlas, GetParam());
  const vulkan::Buffer case_buffer = host_buffer_of("cases", cases);
  const vulkan::Buffer reached = host_buffer("reached", LIT_CASES * sizeof(std::uint32_t));
  dispatch({.shader = "radial_reach",
            .resources = {vulkan::Resource::storage(case_buffer.handle()), vulkan::Resource::storage(reached.handle()),
                          vulkan::Resource::storage(radial.buffer().handle())},
            .groups = {LIT_CASES / 64, 1, 1}});

  const std::vector<float> shadows = shadows_of(cases, lit, atlas, GetParam());
  const std::vector<std::uint32_t> answers = contents<std::uint32_t>(reached);
  std::vector<std::array<std::uint32_t, 3>> found(count);  // in shadow, of these cut, points cut that are lit
  for (std::uint32_t i = 0; i < LIT_CASES; ++i) {
    std::array<std::uint32_t, 3>& sums = found[cases[i].light];
    const bool point_cut = (answers[i] & 1U) == 0;
    sums[0] += shadows[i] == 0.0F ? 1 : 0;
    sums[1] += shadows[i] == 0.0F && point_cut ? 1 : 0;
    sums[2] += shadows[i] > 0.0F && point_cut ? 1 : 0;
    ASSERT_TRUE((answers[i] & 2U) != 0 || point_cut)
        << "a light that reaches a point reaches a sphere with the point in it";
  }
  for (std::uint32_t light = 0; light < count; ++light) {
    EXPECT_EQ(found[light][2], 0U) << "light " << light << " loses what is lit";
    const bool moved = light + 1 == count;
    const bool small = lit.maps[light].side < 64;
    if (moved) {
      EXPECT_EQ(found[light][1], 0U) << "it has moved since";
    } else if (!small) {
      EXPECT_GT(found[light][1], found[light][0] / 16) << "light " << light << " is hardly cut";
    }
  }
}

void append(LitLights& to, const LitLights& from) {
  to.lights.insert(to.lights.end(), from.lights.begin(), from.lights.end());
  to.maps.insert(to.maps.end(), from.maps.begin(), from.maps.end());
}

/// Of the few lights that a device has to spare for, several groups make one bound, of more threads each.
TEST_P(ShadowRadialBounds, AreTheSameHoweverManyGroupsMakeThem) {
  test::Random random(6);
  LitLights few = some_lit_lights(GetParam());
  append(few, large_lit_light(GetParam()));
  LitLights many;
  while (many.lights.size() < 200) append(many, few);
  const GpuImage atlas = depth_image(LIT_ATLAS, LIT_ATLAS, some_wall_depths(random));
  const GpuImage far_atlas = depth_image(LIT_ATLAS, LIT_ATLAS, std::vector(std::size_t{LIT_ATLAS} * LIT_ATLAS, 0.0F));
  const auto bounds_of = [&](const LitLights& lit) {
    ShadowReach reach = reach_of(ShadowReach::Kind::radial, lit, far_atlas, GetParam());
    make_reach(reach, lit, atlas);  // nothing is left of larger bounds
    return bounds_in(reach.buffer(), lit.lights.size());
  };
  const std::vector<Words> of_few = bounds_of(few);
  const std::vector<Words> of_many = bounds_of(many);
  ASSERT_EQ(of_many.size(), many.lights.size());
  for (std::size_t i = 0; i < of_many.size(); ++i) EXPECT_EQ(of_many[i], of_few[i % of_few.size()]) << "light " << i;
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowRadialBounds, ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf),
                         [](const auto& test) { return test.param == ShadowFilter::hard ? "hard" : "pcf"; });

}  // namespace
}  // namespace lamp::app
