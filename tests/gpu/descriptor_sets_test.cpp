// Descriptors in sets instead of pushed ones: the same results, nothing allocated once warm, errors where there is no
// memory. (All that uses a Culler runs once more on a device without push descriptors: ctest's gpu.sets.)
// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

std::size_t pools_made = 0;
std::size_t sets_made = 0;
std::size_t pools_to_make = 0;  ///< before there is no memory left

/// The device of the tests, as if it had no push descriptors, with its pools and sets counted.
vulkan::Device device_with_sets(std::size_t most_pools = ~std::size_t{0}) {
  vulkan::Device device = test_context().device();
  device.vk.vkCmdPushDescriptorSetKHR = nullptr;
  pools_made = sets_made = 0;
  pools_to_make = most_pools;
  device.vk.vkCreateDescriptorPool = [](VkDevice handle, const VkDescriptorPoolCreateInfo* info,
                                        const VkAllocationCallbacks* host, VkDescriptorPool* pool) {
    if (pools_made == pools_to_make) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    ++pools_made;
    return vkCreateDescriptorPool(handle, info, host, pool);
  };
  device.vk.vkAllocateDescriptorSets = [](VkDevice handle, const VkDescriptorSetAllocateInfo* info,
                                          VkDescriptorSet* sets) {
    ++sets_made;
    return vkAllocateDescriptorSets(handle, info, sets);
  };
  return device;
}

vulkan::Pipeline add_pipeline(const vulkan::Device& device) {
  return take(vulkan::Pipeline::compute(device, {.name = "add", .bindings = {{0}, {1}}}, test_shader("plan_add")));
}

class DescriptorSetsTest : public GpuTest {};

TEST_F(DescriptorSetsTest, GiveWhatPushedDescriptorsGive) {
  const EngineFrame frame = engine_frame();
  const vulkan::Device device = device_with_sets();
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler pushed = take(engine_culler(method.name));
    vulkan::Culler in_sets = take(vulkan::Culler::create(device, engine_culler_info(method.name)));
    EXPECT_EQ(cull_and_walk(in_sets, frame), cull_and_walk(pushed, frame));
  }
}

TEST_F(DescriptorSetsTest, AreMadeWithTheCullerAndNeverAgain) {
  const EngineFrame frame = engine_frame();
  const vulkan::Device device = device_with_sets();
  vulkan::Culler culler = take(vulkan::Culler::create(device, engine_culler_info("lamplight")));
  const std::size_t pools = std::exchange(pools_made, 0);
  const std::size_t sets = std::exchange(sets_made, 0);
  EXPECT_GT(pools, 0);
  EXPECT_GT(sets, 4);
  for (std::uint64_t number = 1; number < 12; ++number) {
    expect_no_miss(frame, cull_and_walk(culler, frame));
    if (number % 3 == 0)
      culler.drop(number);
    else
      EXPECT_EQ(take(culler.finish(number)), vulkan::Growth::none);
  }
  EXPECT_EQ(pools_made, 0);
  EXPECT_EQ(sets_made, 0);
}

TEST_F(DescriptorSetsTest, OfFramesUnderWayAreKeptWhenTheCullerGrows) {
  const EngineFrame frame = engine_frame();
  const vulkan::Device device = device_with_sets();
  vulkan::Culler culler = take(vulkan::Culler::create(device, engine_culler_info("clustered", {"mean_capacity=1"})));
  expect_no_miss(frame, cull_and_walk(culler, frame));
  expect_no_miss(frame, cull_and_walk(culler, frame));
  sets_made = 0;
  EXPECT_EQ(take(culler.finish(1)), vulkan::Growth::buffers);
  EXPECT_GT(sets_made, 0) << "the new buffers' passes have sets of their own";
  EXPECT_EQ(take(culler.finish(2)), vulkan::Growth::none);
  expect_no_miss(frame, cull_and_walk(culler, frame));
  EXPECT_EQ(culler.counters().overflowed_cells, 0);
}

TEST_F(DescriptorSetsTest, KeepTheirPoolsWhenTheyAreReset) {
  vulkan::Device device = device_with_sets();
  const vulkan::Pipeline pipeline = add_pipeline(device);
  // llvmpipe gives more sets than a pool was made for.
  static std::map<VkDescriptorPool, std::uint32_t> taken;
  device.vk.vkAllocateDescriptorSets = [](VkDevice handle, const VkDescriptorSetAllocateInfo* info,
                                          VkDescriptorSet* made) {
    if (taken[info->descriptorPool]++ >= 64) return VK_ERROR_OUT_OF_POOL_MEMORY;
    return vkAllocateDescriptorSets(handle, info, made);
  };
  device.vk.vkResetDescriptorPool = [](VkDevice handle, VkDescriptorPool pool, VkDescriptorPoolResetFlags flags) {
    taken.erase(pool);
    return vkResetDescriptorPool(handle, pool, flags);
  };
  vulkan::DescriptorSets sets(device);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 200; ++i) EXPECT_NE(take(sets.allocate(pipeline)), VK_NULL_HANDLE);
    EXPECT_EQ(pools_made, 4);
    sets.reset();
  }
}

// What is pushed between draws changes the bindings that it names, and no others.
TEST_F(DescriptorSetsTest, KeepWhatIsNotPushedAnew) {
  vulkan::Device device = device_with_sets();
  vulkan::DescriptorSets sets(device);
  device.sets = &sets;
  const vulkan::Pipeline pipeline = add_pipeline(device);
  const vulkan::Buffer from = host_buffer_of("from", std::vector<std::uint32_t>(64, 7));
  const vulkan::Buffer to[] = {host_buffer("first", 256), host_buffer("second", 256)};
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(device, commands, tracker);
    recorder.bind(pipeline, std::vector<vulkan::Bound>{{0, vulkan::Resource::storage(from.handle())},
                                                       {1, vulkan::Resource::storage(to[0].handle())}});
    vkCmdDispatch(commands, 1, 1, 1);
    recorder.push(pipeline, std::vector<vulkan::Bound>{{1, vulkan::Resource::storage(to[1].handle())}});
    vkCmdDispatch(commands, 1, 1, 1);
    MaskPass::record_to_host(commands);
  });
  for (const vulkan::Buffer& buffer : to) EXPECT_EQ(contents<std::uint32_t>(buffer), std::vector<std::uint32_t>(64, 7));
}

TEST_F(DescriptorSetsTest, WithoutMemoryAreAnErrorThatNamesThePass) {
  const auto culler = vulkan::Culler::create(device_with_sets(0), engine_culler_info("tiled"));
  ASSERT_FALSE(culler.ok());
  EXPECT_NE(culler.error().text().find("descriptor pool for "), std::string::npos) << culler.error().text();
  EXPECT_NE(culler.error().text().find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos) << culler.error().text();

  const vulkan::Device device = device_with_sets(0);
  vulkan::DescriptorSets sets(device);
  EXPECT_FALSE(sets.error());
  EXPECT_FALSE(sets.allocate(add_pipeline(device)).ok());
  ASSERT_TRUE(sets.error());
  EXPECT_EQ(sets.error()->source, "descriptor pool for add");
  sets.reset();
  EXPECT_FALSE(sets.error());
}

// Layouts differ, so one store keeps both.
TEST_F(DescriptorSetsTest, HavePipelinesOfTheirOwn) {
  vulkan::Device pushes = test_context().device();
  if (!pushes.pushes_descriptors()) GTEST_SKIP() << "the device lacks VK_KHR_push_descriptor";
  vulkan::PipelineStore store;
  vulkan::Device in_sets = device_with_sets();
  pushes.pipelines = in_sets.pipelines = &store;
  EXPECT_NE(add_pipeline(pushes).handle(), add_pipeline(in_sets).handle());
  EXPECT_EQ(store.size(), 2);
}

}  // namespace
}  // namespace lamp::app
