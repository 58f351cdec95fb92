// plan_check: a sound plan passes, and each rule broken alone is named with what was given and what was expected.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "lamplight/method.h"
#include "lamplight/plan.h"
#include "lamplight/shader_code.h"
#include "lamplight/shared/counters.h"

namespace {

using lamp::Access;
using lamp::BufferMemory;
using lamp::DeviceTraits;
using lamp::INPUT_DEPTH;
using lamp::INPUT_FRAME;
using lamp::INPUT_LIGHTS;
using lamp::NO_RESOURCE;
using lamp::Pass;
using lamp::PassKind;
using lamp::Plan;
using lamp::PLAN_BUFFER;
using lamp::ResourceId;

constexpr const char* COMPUTE = "methods/light_bounds";
constexpr const char* SCAN = "methods/lamplight_scan";  // its shared memory grows with its first constant

// Buffers of sound_plan.
constexpr ResourceId SORTED = PLAN_BUFFER;
constexpr ResourceId COUNTERS = PLAN_BUFFER + 1;
constexpr ResourceId ARGUMENTS = PLAN_BUFFER + 2;
constexpr ResourceId LISTS = PLAN_BUFFER + 3;
// Its passes.
constexpr std::size_t HOST = 0;
constexpr std::size_t COUNT = 1;
constexpr std::size_t FILL = 2;

void sort_lights(const lamp::HostContext&) {}

/// One plan with all that a plan can have: host, direct and indirect passes, counters, a fused look-up.
Plan sound_plan() {
  Plan plan;
  plan.width = plan.height = 64;
  plan.light_capacity = 1000;
  plan.cells = 4;
  (void)plan.add({.name = "sorted", .bytes = 4000, .memory = BufferMemory::upload});
  plan.counters = plan.add(
      {.name = "counters", .bytes = sizeof(lamp::shared::Counters), .memory = BufferMemory::counts, .zeroed = true});
  (void)plan.add({.name = "arguments", .bytes = 32, .indirect = true});
  (void)plan.add({.name = "lists", .bytes = 64});
  plan.passes = {{.name = "sort", .kind = PassKind::host, .bindings = {{SORTED, Access::write}}, .host = sort_lights},
                 {.name = "count",
                  .shader = COMPUTE,
                  .bindings = {{INPUT_FRAME},
                               {INPUT_LIGHTS},
                               {INPUT_DEPTH},
                               {SORTED},
                               {COUNTERS, Access::read_write},
                               {ARGUMENTS, Access::write}},
                  .extent = {.lights_per_group = 64}},
                 {.name = "fill",
                  .shader = COMPUTE,
                  .bindings = {{LISTS, Access::write}},
                  .extent = {.indirect = ARGUMENTS, .indirect_offset = 20}}};
  plan.lookup = {.name = "lists", .bindings = {{INPUT_FRAME}, {LISTS}}};
  plan.fused = lamp::FusedLookUp{.lookup = {.name = "fused", .bindings = {{SORTED}, {COUNTERS}}},
                                 .passes = {plan.passes[HOST]},
                                 .group_width = 16,
                                 .group_height = 8};
  return plan;
}

TEST(PlanCheck, ASoundPlanPasses) {
  const auto error = lamp::plan_check(sound_plan(), {});
  EXPECT_FALSE(error.has_value()) << error->text();
}

TEST(PlanCheck, ThePlanOfNothingNeedsOnlyANamedLookUp) {
  Plan plan;
  plan.lookup.name = "all";
  EXPECT_FALSE(lamp::plan_check(plan, {}).has_value());
}

TEST(PlanCheck, WhatFitsExactlyPasses) {
  Plan plan = sound_plan();
  plan.light_capacity = 65535 * 64;
  const DeviceTraits traits{.max_storage_buffer_bytes = std::uint64_t{65535} * 64 * sizeof(lamp::shared::Light),
                            .max_groups = {65535, 1, 1},
                            .max_group_invocations = 16 * 8};
  plan.buffers[LISTS - PLAN_BUFFER].bytes = traits.max_storage_buffer_bytes;
  const auto error = lamp::plan_check(plan, traits);
  EXPECT_FALSE(error.has_value()) << error->text();
}

TEST(PlanCheck, StorageBuffersOfAStageAreCounted) {
  const Plan plan = sound_plan();  // its pass `count` binds five, and the depth image; its look-ups bind two each
  const auto error_at = [&](std::uint32_t limit) { return lamp::plan_check(plan, {.max_storage_buffers = limit}); };
  EXPECT_FALSE(error_at(5).has_value());
  ASSERT_TRUE(error_at(4).has_value());
  EXPECT_EQ(error_at(4)->text(), "pass count: binds 5 storage buffers, a shader on this device sees at most 4");
  Plan lookup_alone = plan;
  lookup_alone.lookup.bindings.assign(6, {INPUT_FRAME});
  const auto error = lamp::plan_check(lookup_alone, {.max_storage_buffers = 5});
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->text(), "look-up lists: binds 6 storage buffers, a shader on this device sees at most 5");
}

// Plans divide by these.
TEST(PlanCheck, TraitsThatNoDeviceHasAreNamed) {
  const auto expect_error = [](const DeviceTraits& traits, const std::string& text) {
    const auto error = lamp::plan_check(sound_plan(), traits);
    ASSERT_TRUE(error.has_value()) << text;
    EXPECT_EQ(error->text(), text);
    for (const lamp::Method& method : lamp::methods()) {
      const auto plan = lamp::make_plan(method, {.width = 64, .height = 64, .light_capacity = 1000, .traits = traits});
      ASSERT_FALSE(plan.ok()) << method.name;
      EXPECT_EQ(plan.error().text(), text) << method.name;
    }
  };
  expect_error({.subgroup_size = 0}, "device trait subgroup_size: expected a power of two, got 0");
  expect_error({.subgroup_size = 24}, "device trait subgroup_size: expected a power of two, got 24");
  expect_error({.max_subgroup_size = 0}, "device trait max_subgroup_size: expected a power of two, got 0");
  expect_error({.storage_offset_alignment = 0},
               "device trait storage_offset_alignment: expected a power of two, got 0");
  expect_error({.storage_offset_alignment = 48},
               "device trait storage_offset_alignment: expected a power of two, got 48");
  expect_error({.max_group_invocations = 0},
               "device trait max_group_invocations: expected at least 128, which Vulkan guarantees, got 0");
  expect_error({.max_loop_rounds = 0}, "device trait max_loop_rounds: expected at least 1, got 0");
  expect_error({.sub_pixel_bits = 32}, "device trait sub_pixel_bits: expected at most 31, got 32");
}

TEST(PlanCheck, APassMayDispatchNoGroupForNoLight) {
  Plan plan = sound_plan();
  plan.light_capacity = 0;
  EXPECT_FALSE(lamp::plan_check(plan, {}).has_value());
}

/// Passes for smaller pictures, of a plan of compute passes alone.
TEST(PlanCheck, FinerPassesAreThoseOfThePlan) {
  Plan plan;
  plan.width = plan.height = 64;
  plan.light_capacity = 1000;
  (void)plan.add({.name = "lists", .bytes = 64});
  plan.passes = {
      {.name = "fill", .shader = SCAN, .bindings = {{PLAN_BUFFER, Access::write}}, .extent = {.cells = {.px = 16}}}};
  plan.lookup = {.name = "lists", .bindings = {{INPUT_FRAME}, {PLAN_BUFFER}}};
  const lamp::FinerPasses sound{.shift = 1, .cells = {.px = 8}, .most_cells = 16, .passes = plan.passes};
  const auto error_of = [&](const auto& breaks) {
    Plan broken = plan;
    broken.finer = {sound};
    breaks(broken.finer.front());
    const auto error = lamp::plan_check(broken, {});
    return error ? error->text() : "none";
  };
  using lamp::FinerPasses;
  EXPECT_EQ(error_of([](FinerPasses&) {}), "none");
  EXPECT_EQ(error_of([](FinerPasses& finer) { finer.shift = 0; }),
            "passes for cells of 8 pixels: must be for smaller cells than the plan's");
  EXPECT_EQ(error_of([](FinerPasses& finer) { finer.passes.front().bindings.front().access = Access::read_write; }),
            "passes for cells of 8 pixels: must have the shaders and bindings of the plan's, of compute passes");
  EXPECT_EQ(error_of([](FinerPasses& finer) { finer.passes.clear(); }),
            "passes for cells of 8 pixels: must have the shaders and bindings of the plan's, of compute passes");
  EXPECT_EQ(error_of([](FinerPasses& finer) { finer.most_cells = 65536; }),
            "passes for cells of 8 pixels: are for 65536 cells, the device takes 65535 work groups");
  EXPECT_EQ(error_of([](FinerPasses& finer) { finer.passes.front().constants = {256}; }),
            "pass fill: needs 16452 bytes of shared memory, the device has 16384");
  EXPECT_NE(
      error_of([](FinerPasses& finer) { finer.passes.front().full_subgroups = 100; }).find("must be full subgroups"),
      std::string::npos);
}

/// A rule: how a sound plan breaks it, and what the error must say.
struct Rule {
  const char* name;
  std::function<void(Plan&)> breaks;
  std::string source;
  std::string message;  ///< a part of it
};

lamp::BufferDesc& lists_of(Plan& plan) { return plan.buffers[LISTS - PLAN_BUFFER]; }

class PlanRule : public ::testing::TestWithParam<Rule> {};

TEST_P(PlanRule, BrokenAloneIsNamed) {
  Plan plan = sound_plan();
  GetParam().breaks(plan);
  const auto error = lamp::plan_check(plan, {});
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->source, GetParam().source);
  EXPECT_NE(error->message.find(GetParam().message), std::string::npos) << error->message;
}

constexpr std::uint32_t MANY = 0x80000001;  // twice this is 2 in 32 bits

const Rule BUFFER_RULES[] = {
    {"EmptyBuffer", [](Plan& p) { lists_of(p).bytes = 0; }, "buffer lists", "positive multiple of 4 bytes, got 0"},
    {"OddBuffer", [](Plan& p) { lists_of(p).bytes = 6; }, "buffer lists", "positive multiple of 4 bytes, got 6"},
    {"LargeBuffer", [](Plan& p) { lists_of(p).bytes = (1ULL << 27) + 4; }, "buffer lists",
     "needs 134217732 bytes, the device's storage buffers hold at most 134217728"},
    {"ZeroedUpload", [](Plan& p) { p.buffers[0].zeroed = true; }, "buffer sorted", "upload buffer cannot be zeroed"},
    {"UploadZeroedByPass", [](Plan& p) { p.buffers[0].zeroed_by_pass = true; }, "buffer sorted",
     "upload buffer cannot be zeroed"},
    {"ZeroedByNoPass", [](Plan& p) { lists_of(p).zeroed_by_pass = true; }, "buffer lists",  // of the fused passes
     "is to be zeroed by a pass, but no pass writes it"},
    {"LargeLightBuffer", [](Plan& p) { p.light_capacity = (1U << 21) + 1; }, "light buffer",
     "needs 134217792 bytes, the device's storage buffers hold at most 134217728"},
    {"CountersAreAnInput", [](Plan& p) { p.counters = INPUT_FRAME; }, "counters", "buffer of the plan"},
    {"CountersBeyondTheBuffers", [](Plan& p) { p.counters = LISTS + 1; }, "counters", "buffer of the plan"},
    {"SmallCounters", [](Plan& p) { p.buffers[COUNTERS - PLAN_BUFFER].bytes = 12; }, "counters",
     "at least 16 bytes, got 12"},
    {"StaleCounters", [](Plan& p) { p.buffers[COUNTERS - PLAN_BUFFER].zeroed = false; }, "counters", "not zeroed"},
    {"CountersInOtherMemory", [](Plan& p) { p.counters = LISTS; }, "counters", "must be in memory of counts"},
    {"CountersOfAllViews", [](Plan& p) { p.buffers[COUNTERS - PLAN_BUFFER].all_views = true; }, "counters",
     "must be in memory of counts, of each view"},
    {"OddCells", [](Plan& p) { lists_of(p).zeroed_cells.px = 8, lists_of(p).cell_bytes = 6; }, "buffer lists",
     "must be all of it"},
    {"FewCells", [](Plan& p) { lists_of(p).zeroed_cells.px = 32, lists_of(p).cell_bytes = 12; }, "buffer lists",
     "must be all of it"},
    {"LargeConeBuffer",
     [](Plan& p) { p.light_layout = {.form = lamp::LightForm::spots, .cones = {.stride = 1 << 18}}; }, "cone buffer",
     "the device's storage buffers hold at most 134217728"},
    {"NoCell", [](Plan& p) { p.cells = 0; }, "cells", "at least one cell"},
};

const Rule PASS_RULES[] = {
    {"LateHostPass", [](Plan& p) { std::swap(p.passes[HOST], p.passes[COUNT]); }, "pass count",
     "reads buffer sorted, which nothing has written"},
    {"HostAfterGpu", [](Plan& p) { p.passes.push_back(p.passes[HOST]); }, "pass sort", "before every GPU pass"},
    {"NoHostFunction", [](Plan& p) { p.passes[HOST].host = nullptr; }, "pass sort", "no host function"},
    {"HostBindsInput", [](Plan& p) { p.passes[HOST].bindings = {{INPUT_FRAME}}; }, "pass sort", "upload buffers only"},
    {"HostBindsDeviceBuffer", [](Plan& p) { p.passes[HOST].bindings = {{LISTS, Access::write}}; }, "pass sort",
     "upload buffers only"},
    {"HostBindsNothing", [](Plan& p) { p.passes[HOST].bindings = {{}}; }, "pass sort", "upload buffers only"},
    {"UnknownShader", [](Plan& p) { p.passes[COUNT].shader = "methods/nothing"; }, "pass count",
     "no shader named 'methods/nothing'"},
    {"GpuWritesUpload", [](Plan& p) { p.passes[COUNT].bindings[3].access = Access::read_write; }, "pass count",
     "binding 3 writes to an upload buffer"},
    {"BindingToNothing", [](Plan& p) { p.passes[COUNT].bindings[1].resource = LISTS + 1; }, "pass count",
     "binding 1 names resource 12, which does not exist"},
    {"UnsetBinding", [](Plan& p) { p.passes[COUNT].bindings[1] = {}; }, "pass count", "binding 1 names resource"},
    {"WriteToInput", [](Plan& p) { p.passes[COUNT].bindings[2].access = Access::write; }, "pass count",
     "binding 2 writes to an input"},
    {"ReadOfNothing", [](Plan& p) { p.passes[FILL].bindings[0].access = Access::read; }, "pass fill",
     "binding 0 reads buffer lists, which nothing has written"},
    {"ReadWriteOfNothing", [](Plan& p) { p.passes[FILL].bindings[0].access = Access::read_write; }, "pass fill",
     "binding 0 reads buffer lists, which nothing has written"},
    {"ZeroedByPassThatReads",
     [](Plan& p) {
       p.buffers[COUNTERS - PLAN_BUFFER].zeroed = false;
       p.buffers[COUNTERS - PLAN_BUFFER].zeroed_by_pass = true;
     },
     "pass count", "reads buffer counters, which nothing has written"},
    {"KeptPassThatZeroes",
     [](Plan& p) {
       lists_of(p).zeroed_by_pass = true;
       p.passes[FILL].on_projection_change = true;
     },
     "pass fill", "binds buffer lists, which is zeroed in every frame"},
    {"MuchSharedMemory", [](Plan& p) { (p.passes[COUNT].shader = SCAN, p.passes[COUNT].constants = {256}); },
     "pass count", "needs 16452 bytes of shared memory, the device has 16384"},
    {"SubgroupsThatAreNotFull", [](Plan& p) { p.passes[COUNT].full_subgroups = 100; }, "pass count",
     "groups of 100 threads must be full subgroups"},
    {"SubgroupsBeyondAGroup", [](Plan& p) { p.passes[COUNT].full_subgroups = 256; }, "pass count",
     "and at most 128 threads"},
    {"KeptWithoutTheFusedOnes", [](Plan& p) { p.passes[FILL].on_projection_change = true; }, "pass fill",
     "is kept, so the passes with and those without a fused look-up must have it"},
    {"KeptWithTheFusedOnesAlone",
     [](Plan& p) { (p.fused->passes[HOST].name = "other", p.fused->passes[HOST]).on_projection_change = true; },
     "pass other", "is kept, so the passes with and those without a fused look-up must have it"},
    {"OnceIntoEachView", [](Plan& p) { p.passes[FILL].once = true; }, "pass fill",
     "runs once for all views, but binds what each has its own of"},
    {"EachViewIntoOne", [](Plan& p) { p.buffers[LISTS - PLAN_BUFFER].all_views = true; }, "pass fill",
     "runs for each view, but writes buffer lists, which is one for all"},
    {"KeptPassWithZeroedBuffer", [](Plan& p) { p.passes[COUNT].on_projection_change = true; }, "pass count",
     "binds buffer counters, which is zeroed in every frame"},
    {"ReadInTheWritingPass", [](Plan& p) { p.passes[FILL].bindings = {{LISTS, Access::write}, {LISTS}}; }, "pass fill",
     "binding 1 reads buffer lists, which nothing has written"},
};

const Rule EXTENT_RULES[] = {
    {"NoGroups", [](Plan& p) { p.passes[COUNT].extent = {.y = 0}; }, "pass count", "needs 0 work groups along axis 1"},
    {"ManyGroups", [](Plan& p) { p.passes[COUNT].extent = {.z = 65536}; }, "pass count",
     "needs 65536 work groups along axis 2, the device takes 1 to 65535"},
    {"ManyLightGroups", [](Plan& p) { p.passes[COUNT].extent = {.lights_per_group = 1}, p.light_capacity = 65536; },
     "pass count", "needs 65536 work groups along axis 0"},
    {"ManyTiles", [](Plan& p) { p.passes[COUNT].extent = {.cells = {.px = 1}}, p.width = 65536; }, "pass count",
     "needs 65536 work groups along axis 0"},
    {"ManyCells",
     [](Plan& p) { p.passes[COUNT].extent = {.x = 0, .cells = {.px = 1, .layers = 17}, .cells_per_group = 1}; },
     "pass count", "needs 69632 work groups along axis 0"},
    {"GroupsForNoCells", [](Plan& p) { p.passes[COUNT].extent = {.cells_per_group = 1}; }, "pass count",
     "has groups for cells, and no cells"},
    {"IndirectInput", [](Plan& p) { p.passes[FILL].extent.indirect = INPUT_LIGHTS; }, "pass fill", "marked indirect"},
    {"IndirectUnmarked", [](Plan& p) { p.passes[FILL].extent.indirect = LISTS; }, "pass fill", "marked indirect"},
    {"IndirectOdd", [](Plan& p) { p.passes[FILL].extent.indirect_offset = 10; }, "pass fill", "indirect offset 10"},
    {"IndirectPastTheEnd", [](Plan& p) { p.passes[FILL].extent.indirect_offset = 24; }, "pass fill",
     "indirect offset 24 is outside"},
    {"IndirectWrapsAround", [](Plan& p) { p.passes[FILL].extent.indirect_offset = ~0ULL - 3; }, "pass fill",
     "is outside its buffer"},
    {"IndirectOfNothing", [](Plan& p) { p.passes[COUNT].bindings.pop_back(); }, "pass fill",
     "indirect counts come from buffer arguments, which nothing has written"},
};

Pass raster_pass() {
  return {.name = "draw", .kind = PassKind::raster, .shader = COMPUTE, .raster = {.vertex_shader = COMPUTE}};
}

const Rule RASTER_RULES[] = {
    {"NoPicture", [](Plan& p) { p.passes[FILL] = raster_pass(), p.height = 0; }, "pass draw",
     "viewport must be 1 to 4096 pixels a side, got 64x0"},
    {"LargeViewport", [](Plan& p) { (p.passes[FILL] = raster_pass()).raster.pixel = 2, p.width = 8193; }, "pass draw",
     "viewport must be 1 to 4096 pixels a side, got 4097x32"},
    {"NoViewportPixel", [](Plan& p) { (p.passes[FILL] = raster_pass()).raster.pixel = 0; }, "pass draw",
     "at least one pixel of the picture"},
    {"ThreeSamples", [](Plan& p) { (p.passes[FILL] = raster_pass()).raster.samples = 3; }, "pass draw",
     "samples must be 1 or 4, got 3"},
    {"ConservativeOnADeviceWithout", [](Plan& p) { (p.passes[FILL] = raster_pass()).raster.conservative = true; },
     "pass draw", "needs conservative rasterization"},
    {"WrongStage", [](Plan& p) { p.passes[FILL] = raster_pass(); }, "pass draw",
     "the shader 'methods/light_bounds' is not a .vert shader"},
    {"UnknownVertexShader", [](Plan& p) { (p.passes[FILL] = raster_pass()).raster.vertex_shader = "none"; },
     "pass draw", "no shader named 'none'"},
    {"SmallDrawArguments",
     [](Plan& p) { (p.passes[FILL] = raster_pass()).extent = {.indirect = ARGUMENTS, .indirect_offset = 20}; },
     "pass draw", "indirect offset 20 is outside"},
};

const Rule LOOKUP_RULES[] = {
    {"NoName", [](Plan& p) { p.lookup.name.clear(); }, "look-up", "has no name"},
    {"Writes", [](Plan& p) { p.lookup.bindings[1].access = Access::read_write; }, "look-up lists", "read-only"},
    {"BindsCounters", [](Plan& p) { p.lookup.bindings[1].resource = COUNTERS; }, "look-up lists",
     "lie elsewhere in each frame"},
    {"BindsNothing", [](Plan& p) { p.lookup.bindings[1].resource = NO_RESOURCE; }, "look-up lists", "does not exist"},
    {"ReadsNothing", [](Plan& p) { p.passes.pop_back(); }, "look-up lists", "lists, which nothing has written"},
    {"FusedReadsNothing", [](Plan& p) { p.fused->passes.clear(); }, "look-up fused",
     "binding 0 reads buffer sorted, which nothing has written"},
    {"FusedReadsTheOtherPasses", [](Plan& p) { p.fused->lookup.bindings = {{LISTS}}; }, "look-up fused",
     "lists, which nothing has written"},
    {"FusedWrites", [](Plan& p) { p.fused->lookup.bindings[0].access = Access::write; }, "look-up fused", "read-only"},
    {"FusedNoThread", [](Plan& p) { p.fused->group_height = 0; }, "fused look-up fused", "must have 1 to 128 threads"},
    {"FusedManyThreads", [](Plan& p) { p.fused->group_height = 9; }, "fused look-up fused", "must have 1 to 128"},
    {"FusedMuchSharedMemory", [](Plan& p) { p.fused->shared_bytes = 16388; }, "fused look-up fused",
     "needs 16388 bytes of shared memory, the device has 16384"},
    {"FusedThreadsWrapAround", [](Plan& p) { p.fused->group_width = MANY, p.fused->group_height = 2; },
     "fused look-up fused", "must have 1 to 128 threads"},
};

std::string name_of(const ::testing::TestParamInfo<Rule>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Buffers, PlanRule, ::testing::ValuesIn(BUFFER_RULES), name_of);
INSTANTIATE_TEST_SUITE_P(Passes, PlanRule, ::testing::ValuesIn(PASS_RULES), name_of);
INSTANTIATE_TEST_SUITE_P(Extents, PlanRule, ::testing::ValuesIn(EXTENT_RULES), name_of);
INSTANTIATE_TEST_SUITE_P(Raster, PlanRule, ::testing::ValuesIn(RASTER_RULES), name_of);
INSTANTIATE_TEST_SUITE_P(LookUps, PlanRule, ::testing::ValuesIn(LOOKUP_RULES), name_of);

}  // namespace
