// The recorder around plans: times of passes in order, labels, errors of what cannot be built, buffers that go away.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "gpu/plan_harness.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

using Words = std::vector<std::uint32_t>;

class RecorderTest : public GpuTest {};

Plan two_passes() {
  Plan plan;
  const ResourceId words = plan.add({.name = "words", .bytes = 64});
  plan.passes = {words_pass("plan_write", {5, 1}, {{words, Access::write}}, 16),
                 words_pass("plan_multiply", {3}, {{words, Access::read_write}}, 16)};
  plan.passes[0].name = "first";
  plan.passes[1].name = "second";
  return plan;
}

std::vector<std::string> names(const std::vector<vulkan::Timestamps::Time>& times) {
  std::vector<std::string> passes;
  for (const auto& time : times) passes.push_back(time.pass);
  return passes;
}

TEST_F(RecorderTest, EachPassHasATimeInOrder) {
  PlanHarness harness(two_passes());
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(harness.run()[0], Words(16, 15));
    EXPECT_EQ(names(harness.times()), (std::vector<std::string>{"first", "second"}));
    for (const auto& time : harness.times()) {
      EXPECT_GE(time.ms(), 0.0);
      EXPECT_LT(time.ms(), 10000.0);
    }
  }
}

// The clearing of a plan's buffers is a pass with a time; passes follow each other on one clock.
TEST_F(RecorderTest, ClearingHasATimeAndPassesFollowEachOther) {
  Plan plan;
  const ResourceId words = plan.add({.name = "words", .bytes = 64, .zeroed = true});
  plan.passes = {words_pass("plan_multiply", {3}, {{words, Access::read_write}}, 16)};
  plan.passes[0].name = "only";
  PlanHarness harness(plan);
  EXPECT_EQ(harness.run()[0], Words(16, 0));
  ASSERT_EQ(names(harness.times()), (std::vector<std::string>{"clear", "only"}));
  EXPECT_EQ(harness.times()[0].begin_ms, 0.0);
  EXPECT_LE(harness.times()[0].end_ms, harness.times()[1].begin_ms);
  EXPECT_LE(harness.times()[1].begin_ms, harness.times()[1].end_ms);
}

TEST_F(RecorderTest, PassesOfOnePartShareATime) {
  Plan plan = two_passes();
  plan.passes.push_back(plan.passes[1]);
  plan.passes[2].name = "third";
  PlanHarness harness(plan);
  harness.time_parts([](std::string_view pass) { return pass == "third" ? 1 : 0; });
  EXPECT_EQ(harness.run()[0], Words(16, 45));
  ASSERT_EQ(names(harness.times()), (std::vector<std::string>{"first", "third"}));
  EXPECT_LE(harness.times()[0].end_ms, harness.times()[1].end_ms);
  harness.time_parts({});
  EXPECT_EQ(harness.run()[0][0], 45U) << "the first pass writes anew";
  EXPECT_EQ(names(harness.times()), (std::vector<std::string>{"first", "second", "third"}));
}

// Neighbours that touch nothing of one another have no barrier between them; the third waits for both.
TEST_F(RecorderTest, IndependentPassesAreRightSideBySide) {
  Plan plan;
  const ResourceId a = plan.add({.name = "a", .bytes = 1 << 16});
  const ResourceId b = plan.add({.name = "b", .bytes = 1 << 16});
  constexpr std::uint32_t WORDS = (1 << 16) / 4;
  plan.passes = {words_pass("plan_write", {5, 1}, {{a, Access::write}}, WORDS),
                 words_pass("plan_write", {7, 1}, {{b, Access::write}}, WORDS),
                 words_pass("plan_multiply", {3}, {{a, Access::read_write}}, WORDS),
                 words_pass("plan_multiply", {2}, {{b, Access::read_write}}, WORDS)};
  PlanHarness harness(plan);
  for (int frame = 0; frame < 3; ++frame) {
    const auto words = harness.run();
    EXPECT_EQ(words[0], Words(WORDS, 15));
    EXPECT_EQ(words[1], Words(WORDS, 14));
  }
}

TEST_F(RecorderTest, PassesThatAreKeptRunOnceForAProjection) {
  Plan plan = two_passes();
  plan.passes[0].on_projection_change = true;
  PlanHarness harness(plan);
  EXPECT_EQ(harness.run()[0], Words(16, 15));
  EXPECT_EQ(harness.run()[0], Words(16, 45));
  EXPECT_EQ(names(harness.times()), (std::vector<std::string>{"second"}));
  EXPECT_EQ(harness.runner().projection_rebuilds(), 1);
}

TEST_F(RecorderTest, PipelinesThatAreAlikeAreMadeOnce) {
  vulkan::PipelineStore store;
  vulkan::Device device = test_context().device();
  device.pipelines = &store;
  const auto write = [&](std::uint32_t constant, std::uint32_t binding) {
    return take(vulkan::Pipeline::compute(device,
                                          {.name = "write", .constants = {{0, constant}}, .bindings = {{0}, {binding}}},
                                          test_shader("plan_write")));
  };
  const vulkan::Pipeline first = write(1, 1);
  EXPECT_EQ(write(1, 1).handle(), first.handle());
  EXPECT_NE(write(2, 1).handle(), first.handle());
  EXPECT_NE(write(1, 2).handle(), first.handle());
  EXPECT_EQ(store.size(), 3);
  device.pipelines = nullptr;
  EXPECT_NE(write(1, 1).handle(), first.handle());
  EXPECT_EQ(store.size(), 3);
}

TEST_F(RecorderTest, APipelineThatManyAskForAtOnceIsMadeOnce) {
  vulkan::PipelineStore store;
  std::atomic<int> made = 0;
  std::array<VkPipeline, 8> handles{};
  const auto make = [&] {
    ++made;
    return vulkan::Pipeline::compute(test_context().device(), {.name = "write", .bindings = {{0}, {1}}},
                                     test_shader("plan_write"));
  };
  std::vector<std::jthread> threads;
  for (VkPipeline& handle : handles)
    threads.emplace_back([&] { handle = take(store.find_or_make("one", make)).handle(); });
  threads.clear();  // waits for them
  EXPECT_EQ(made, 1);
  EXPECT_EQ(std::ranges::count(handles, handles.front()), handles.size());
}

TEST_F(RecorderTest, APipelineThatCannotBeMadeIsTriedAgain) {
  vulkan::PipelineStore store;
  const auto fail = [] { return Result<vulkan::Pipeline>(lamp::Error{"pipeline one", "for a test"}); };
  EXPECT_FALSE(store.find_or_make("one", fail).ok());
  EXPECT_EQ(store.size(), 0);
  EXPECT_FALSE(store.find_or_make("one", fail).ok());
}

TEST_F(RecorderTest, EmptyPlansTakeNoTimeAndHostPassesThatOfTheirUpload) {
  Plan plan;
  PlanHarness empty(plan);
  EXPECT_TRUE(empty.run().empty());
  EXPECT_TRUE(empty.times().empty());
  const ResourceId upload = plan.add({.name = "upload", .bytes = 4, .memory = BufferMemory::upload});
  plan.passes = {
      {.name = "host", .kind = PassKind::host, .bindings = {{upload, Access::write}}, .host = [](const HostContext&) {
       }}};
  PlanHarness harness(plan);
  EXPECT_EQ(harness.run().size(), 1);
  EXPECT_EQ(names(harness.times()), std::vector<std::string>{"upload"});
}

TEST_F(RecorderTest, WorksWithoutDebugUtils) {
  PlanHarness harness(two_passes());
  harness.device.vk.vkCmdBeginDebugUtilsLabelEXT = nullptr;
  harness.device.vk.vkCmdEndDebugUtilsLabelEXT = nullptr;
  harness.device.vk.vkSetDebugUtilsObjectNameEXT = nullptr;
  EXPECT_EQ(harness.run()[0], Words(16, 15));
}

TEST_F(RecorderTest, UnknownShadersAreNamed) {
  Plan plan = two_passes();
  plan.passes[1].shader = "plan_mutliply";
  const auto runner = vulkan::PlanRunner::create(test_context().device(), plan, test_shader_source());
  ASSERT_FALSE(runner.ok());
  EXPECT_NE(runner.error().text().find("plan_mutliply"), std::string::npos) << runner.error().text();

  plan = two_passes();
  const auto embedded = vulkan::PlanRunner::create(test_context().device(), plan);
  ASSERT_FALSE(embedded.ok()) << "tests' shaders are not the library's";
  EXPECT_NE(embedded.error().text().find("plan_write"), std::string::npos) << embedded.error().text();
}

TEST_F(RecorderTest, LookUpsAreBoundAsThePlanSays) {
  Plan plan = two_passes();
  plan.lookup = {.name = "some", .constants = {7, 8}, .bindings = {{INPUT_FRAME}, {PLAN_BUFFER}, {INPUT_DEPTH}}};
  const PlanHarness harness(plan);
  const GpuImage depth = depth_image(1, 1, {0.5F});
  const vulkan::Buffer frame = host_buffer("frame", sizeof(shared::Frame));
  const auto bound = harness.runner().lookup({.frame = frame.handle(), .depth = depth.sampled()});
  EXPECT_EQ(bound.name, "some");
  ASSERT_EQ(bound.constants.size(), 2);
  EXPECT_EQ(bound.constants[1].id, LOOKUP_CONSTANT + 1);
  EXPECT_EQ(bound.constants[1].value, 8);
  ASSERT_EQ(bound.resources.size(), 3);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(bound.resources[i].binding, LOOKUP_BINDING + i);
  EXPECT_EQ(bound.resources[0].resource.buffer, frame.handle());
  EXPECT_EQ(bound.resources[1].resource.buffer, harness.runner().buffer(PLAN_BUFFER));
  EXPECT_EQ(bound.resources[2].resource.view, depth.view());
  EXPECT_EQ(harness.runner().buffer(INPUT_FRAME), VK_NULL_HANDLE);
  EXPECT_EQ(harness.runner().buffer(NO_RESOURCE), VK_NULL_HANDLE);
}

TEST_F(RecorderTest, ImagesChangeTheirLayoutBetweenUses) {
  const std::vector<float> depth{0.125F, 0.25F, 0.5F, 1.0F, 0.0F, 0.75F};
  GpuImage image(test_context().device(), {.name = "image",
                                           .width = 3,
                                           .height = 2,
                                           .format = VK_FORMAT_D32_SFLOAT,
                                           .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  const vulkan::Buffer from = host_buffer_of("from", depth);
  const vulkan::Buffer to = host_buffer("to", from.bytes());
  const VkBufferImageCopy whole{.imageSubresource = {image.aspect(), 0, 0, 1}, .imageExtent = {3, 2, 1}};
  vulkan::AccessTracker tracker;
  for (int frame = 0; frame < 2; ++frame) {
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      recorder.barrier({copies_to(image.transfer_target())});
      vkCmdCopyBufferToImage(commands, from.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
      recorder.barrier({reads(image.sampled(), VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)});
      recorder.barrier({reads(image.sampled(), VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT)});
      recorder.barrier({copies_from(image.transfer_source()), copies_to(vulkan::Resource::storage(to.handle()))});
      vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1, &whole);
      recorder.barrier({host_reads(vulkan::Resource::storage(to.handle()))});
    });
    EXPECT_EQ(contents<float>(to), depth);
  }
}

TEST_F(RecorderTest, AForgottenBuffersHandleStartsAnew) {
  vulkan::AccessTracker tracker;
  for (int round = 0; round < 4; ++round) {
    const vulkan::Buffer buffer = host_buffer("round", 64);
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      recorder.barrier({copies_to(vulkan::Resource::storage(buffer.handle()))});
      vkCmdFillBuffer(commands, buffer.handle(), 0, VK_WHOLE_SIZE, 0x01020304U + static_cast<std::uint32_t>(round));
      recorder.barrier({host_reads(vulkan::Resource::storage(buffer.handle()))});
    });
    EXPECT_EQ(contents<std::uint32_t>(buffer), Words(16, 0x01020304U + static_cast<std::uint32_t>(round)));
    tracker.forget(buffer.handle());
  }
}

VkMemoryBarrier2 last_barrier{};

VKAPI_ATTR void VKAPI_CALL keep_barrier(VkCommandBuffer, const VkDependencyInfo* dependency) {
  ASSERT_EQ(dependency->memoryBarrierCount, 1);
  last_barrier = dependency->pMemoryBarriers[0];
}

// Fragments see the write as a uniform buffer, compute shaders as a storage buffer; then these as a uniform buffer,
// too.
TEST_F(RecorderTest, EachReadersStageSeesTheWriteByItsOwnAccess) {
  vulkan::DeviceFunctions vk{};
  vk.vkCmdPipelineBarrier2 = keep_barrier;
  const vulkan::Buffer buffer = host_buffer("buffer", 4);
  vulkan::AccessTracker tracker;
  std::vector<VkMemoryBarrier2> since_the_write;
  const auto use = [&](VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
    last_barrier = {};
    tracker.barrier(vk, VK_NULL_HANDLE,
                    std::array{vulkan::Use{vulkan::Resource::storage(buffer.handle()), stages, access}});
    since_the_write.push_back(last_barrier);
  };
  use(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  use(VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_UNIFORM_READ_BIT);
  use(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  use(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_UNIFORM_READ_BIT);
  EXPECT_TRUE(std::ranges::any_of(since_the_write, [](const VkMemoryBarrier2& barrier) {
    return (barrier.dstStageMask & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT) != 0 &&
           (barrier.dstAccessMask & VK_ACCESS_2_UNIFORM_READ_BIT) != 0;
  }));
}

}  // namespace
}  // namespace lamp::app
