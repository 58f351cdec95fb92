// Plans on a device: host, compute and raster passes, extents of every kind, zeroed buffers, times, hazards.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "gpu/plan_harness.h"

namespace lamp::app {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t WORDS = 1000;

class PlanRunnerTest : public GpuTest {};

ResourceId add_words(Plan& plan, const char* name, std::uint32_t words = WORDS) {
  return plan.add({.name = name, .bytes = words * sizeof(std::uint32_t)});
}

std::vector<Light> lights(std::uint32_t count, float range = 1.0F) {
  return std::vector<Light>(count, Light{.range = range});
}

TEST_F(PlanRunnerTest, HostPassFeedsAComputePassFrameAfterFrame) {
  Plan plan;
  const ResourceId upload =
      plan.add({.name = "upload", .bytes = WORDS * sizeof(std::uint32_t), .memory = BufferMemory::upload});
  const ResourceId result = add_words(plan, "result");
  plan.passes = {{.name = "host",
                  .kind = PassKind::host,
                  .bindings = {{upload, Access::write}},
                  .host =
                      [](const HostContext& context) {
                        const auto* ranges = context.lights.data();
                        for (std::uint32_t i = 0; i < WORDS; ++i) {
                          const auto value = static_cast<std::uint32_t>(ranges[i % context.lights.size()].range) + i;
                          std::memcpy(&context.buffers[0][i * sizeof(value)], &value, sizeof(value));
                        }
                      }},
                 words_pass("plan_add", {5}, {{upload}, {result, Access::write}}, WORDS)};
  PlanHarness harness(plan, lights(1, 100.0F));
  for (const float range : {100.0F, 300.0F, 200.0F}) {
    harness.set_lights(lights(1, range));
    const Words found = harness.run()[1];
    for (std::uint32_t i = 0; i < WORDS; ++i) ASSERT_EQ(found[i], static_cast<std::uint32_t>(range) + i + 5) << i;
  }
}

TEST_F(PlanRunnerTest, EveryHazardBetweenPassesIsOrdered) {
  Plan plan;
  const ResourceId a = add_words(plan, "a");
  const ResourceId b = add_words(plan, "b");
  plan.passes = {
      words_pass("plan_write", {7, 1}, {{a, Access::write}}, WORDS),
      words_pass("plan_write", {9, 2}, {{a, Access::write}}, WORDS),  // write after write
      words_pass("plan_add", {1}, {{a}, {b, Access::write}}, WORDS),  // read after write
      words_pass("plan_write", {3, 3}, {{a, Access::write}}, WORDS),  // write after read
      words_pass("plan_multiply", {10}, {{b, Access::read_write}}, WORDS),
      words_pass("plan_multiply", {10}, {{b, Access::read_write}}, WORDS),
      words_pass("plan_add", {0}, {{b}, {a, Access::write}}, WORDS),  // write after write, read after write
      words_pass("plan_add", {4}, {{a}, {b, Access::write}}, WORDS),  // write after read, read after write
  };
  PlanHarness harness(plan);
  for (int frame = 0; frame < 2; ++frame) {
    const auto found = harness.run();
    for (std::uint32_t i = 0; i < WORDS; ++i) {
      const std::uint32_t expected = ((i % 2 == 0 ? 9 : 7) + 1) * 100;
      ASSERT_EQ(found[0][i], expected) << i;
      ASSERT_EQ(found[1][i], expected + 4) << i;
    }
  }
}

// The tests above rest on synchronization validation. (It keeps quiet about a write after a write by two dispatches.)
TEST_F(PlanRunnerTest, ValidationSeesHazardsThatNobodyOrders) {
  const vulkan::Device& device = test_context().device();
  const vulkan::Buffer from = host_buffer("from", 64);
  const vulkan::Buffer to = host_buffer("to", 64);
  const vulkan::Pipeline write =
      take(vulkan::Pipeline::compute(device, {.name = "write", .bindings = {{0}}}, test_shader("plan_write")));
  const vulkan::Pipeline add =
      take(vulkan::Pipeline::compute(device, {.name = "add", .bindings = {{0}, {1}}}, test_shader("plan_add")));
  const auto run = [&](std::initializer_list<const vulkan::Pipeline*> pipelines) {
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      vulkan::Recorder recorder(device, commands, tracker);
      for (const vulkan::Pipeline* pipeline : pipelines) {
        const std::vector<vulkan::Bound> bound{{0, vulkan::Resource::storage(from.handle())},
                                               {1, vulkan::Resource::storage(to.handle())}};
        recorder.bind(*pipeline, std::span(bound).first(pipeline == &add ? 2 : 1));
        vkCmdDispatch(commands, 1, 1, 1);
      }
    });
    const std::vector<std::string> messages = test_context().take_messages();
    return messages.empty() ? "" : messages[0];
  };
  EXPECT_NE(run({&write, &add}).find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos);
  EXPECT_NE(run({&add, &write}).find("SYNC-HAZARD-WRITE-AFTER-READ"), std::string::npos);
}

TEST_F(PlanRunnerTest, ZeroedBuffersStartEveryFrameAtZero) {
  Plan plan;
  const ResourceId counts = plan.add({.name = "counts", .bytes = 16, .zeroed = true});
  const ResourceId kept = plan.add({.name = "kept", .bytes = 16});
  plan.passes = {
      {.name = "count", .shader = "plan_count", .bindings = {{counts, Access::read_write}}, .extent = {3, 4, 5}},
      words_pass("plan_add", {0}, {{counts}, {kept, Access::write}}, 4)};
  PlanHarness harness(plan);
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(harness.run()[1], (Words{60, 2, 3, 4}));
}

TEST_F(PlanRunnerTest, GroupsForLightsAreRoundedUpAndNoneForNoLight) {
  Plan plan;
  const ResourceId counts = plan.add({.name = "counts", .bytes = 16, .zeroed = true});
  plan.passes = {{.name = "count",
                  .shader = "plan_count",
                  .bindings = {{counts, Access::read_write}},
                  .extent = {.y = 2, .lights_per_group = 64}}};
  PlanHarness harness(plan);
  for (const auto& [count, groups] : {std::pair(0U, 0U), {1U, 1U}, {63U, 1U}, {64U, 1U}, {65U, 2U}, {1000U, 16U}}) {
    harness.set_lights(lights(count));
    const Words found = harness.run()[0];
    EXPECT_EQ(found[0], 2 * groups) << count << " lights";
    EXPECT_EQ(found[1], groups == 0 ? 0 : groups - 1) << count << " lights";
  }
}

TEST_F(PlanRunnerTest, IndirectDispatchReadsItsCountsAtTheirOffset) {
  Plan plan;
  const ResourceId indirect = plan.add({.name = "indirect", .bytes = 32, .indirect = true});
  const ResourceId counts = plan.add({.name = "counts", .bytes = 16, .zeroed = true});
  plan.passes = {{.name = "counts of groups",
                  .shader = "plan_words",
                  .constants = {1, 1, 1, 1, 6, 3, 2, 0},
                  .bindings = {{indirect, Access::write}}},
                 {.name = "count",
                  .shader = "plan_count",
                  .bindings = {{counts, Access::read_write}},
                  .extent = {.indirect = indirect, .indirect_offset = 16}}};
  PlanHarness harness(plan);
  for (int frame = 0; frame < 2; ++frame) EXPECT_EQ(harness.run()[1], (Words{36, 5, 2, 1}));
}

/// A plan that draws the triangle into a buffer of covered samples, `instances` times.
struct DrawParam {
  std::uint32_t samples;
  bool indirect;
};

class PlanRaster : public GpuTest, public ::testing::WithParamInterface<DrawParam> {};

TEST_P(PlanRaster, FragmentsWriteToBuffers) {
  constexpr std::uint32_t WIDTH = 16;
  constexpr std::uint32_t HEIGHT = 16;
  constexpr std::uint32_t INSTANCES = 3;
  const auto [samples, is_indirect] = GetParam();
  Plan plan;
  plan.width = WIDTH;
  plan.height = HEIGHT;
  const ResourceId covered = plan.add({.name = "covered", .bytes = WIDTH * HEIGHT * 4, .zeroed = true});
  const ResourceId indirect = plan.add({.name = "indirect", .bytes = 32, .indirect = true});
  Pass draw{.name = "draw",
            .kind = PassKind::raster,
            .shader = "plan_covered",
            .constants = {WIDTH},
            .bindings = {{covered, Access::read_write}},
            .extent = {.x = 3, .y = INSTANCES},
            .raster = {.vertex_shader = "plan_triangle", .samples = samples}};
  if (is_indirect) draw.extent = {.indirect = indirect, .indirect_offset = 16};
  plan.passes = {{.name = "counts",
                  .shader = "plan_words",
                  .constants = {0, 0, 0, 0, 3, INSTANCES, 0, 0},
                  .bindings = {{indirect, Access::write}}},
                 draw,
                 words_pass("plan_multiply", {2}, {{covered, Access::read_write}}, WIDTH * HEIGHT)};
  PlanHarness harness(plan);
  for (int frame = 0; frame < 2; ++frame) {
    const Words found = harness.run()[0];
    for (std::uint32_t y = 0; y < HEIGHT; ++y) {
      for (std::uint32_t x = 0; x < WIDTH; ++x) {
        const std::uint32_t value = found[x + WIDTH * y];
        const bool diagonal = x + y + 1 == WIDTH;  // one sample in the middle: on the edge; of four: some
        const std::uint32_t least = x + y + 1 < WIDTH ? 2 * INSTANCES * samples : diagonal && samples == 4 ? 1 : 0;
        const std::uint32_t most = x + y + 1 < WIDTH ? least : diagonal ? 2 * INSTANCES * samples - (samples / 4) : 0;
        ASSERT_GE(value, least) << x << ", " << y;
        ASSERT_LE(value, most) << x << ", " << y;
      }
    }
  }
}

TEST_F(PlanRunnerTest, FrontFacesAreCounterClockwise) {
  using Cull = RasterState::Cull;
  for (const auto& [cull, drawn] : {std::pair(Cull::none, true), {Cull::front, false}, {Cull::back, true}}) {
    Plan plan;
    plan.width = plan.height = 2;
    const ResourceId covered = plan.add({.name = "covered", .bytes = 16, .zeroed = true});
    plan.passes = {{.name = "draw",
                    .kind = PassKind::raster,
                    .shader = "plan_covered",
                    .constants = {2},
                    .bindings = {{covered, Access::read_write}},
                    .extent = {.x = 3},
                    .raster = {.vertex_shader = "plan_triangle", .cull = cull}}};
    EXPECT_EQ(PlanHarness(plan).run()[0][0], drawn ? 1 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Draws, PlanRaster,
                         ::testing::Values(DrawParam{1, false}, DrawParam{1, true}, DrawParam{4, false},
                                           DrawParam{4, true}),
                         [](const auto& test) {
                           return std::to_string(test.param.samples) + (test.param.indirect ? "_indirect" : "_direct");
                         });

}  // namespace
}  // namespace lamp::app
