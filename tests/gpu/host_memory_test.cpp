// A host's allocator and pipeline cache: a Culler's buffers lie in one block that the host owns, at offsets, and all of
// them come back to it.
// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

/// One block of memory that the processor sees, handed out from its beginning.
class Block {
 public:
  explicit Block(const vulkan::Device& device) : device_(device) {
    constexpr VkMemoryPropertyFlags HOST = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .allocationSize = BYTES,
                                        .memoryTypeIndex = take(vulkan::find_memory_type(device, ~0U, HOST))};
    EXPECT_EQ(vkAllocateMemory(device.handle, &allocate, nullptr, &memory_), VK_SUCCESS);
    void* mapped = nullptr;
    EXPECT_EQ(vkMapMemory(device.handle, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), VK_SUCCESS);
    mapped_ = static_cast<std::byte*>(mapped);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  ~Block() { vkFreeMemory(device_.handle, memory_, nullptr); }

  [[nodiscard]] vulkan::MemoryCallbacks callbacks() {
    return {.user = this,
            .allocate = [](void* user, VkBuffer, const VkMemoryRequirements& needs, vulkan::MemoryUse use,
                           vulkan::Allocation& out) { return static_cast<Block*>(user)->allocate(needs, use, out); },
            .release =
                [](void* user, const vulkan::Allocation& allocation) {
                  EXPECT_EQ(static_cast<Block*>(user)->live.erase(allocation.offset), 1)
                      << "released what it did not have";
                }};
  }

  std::set<VkDeviceSize> live;  ///< offsets
  std::size_t allocations = 0;
  std::size_t fails_at = ~std::size_t{0};

 private:
  static constexpr VkDeviceSize BYTES = 64U << 20;

  VkResult allocate(const VkMemoryRequirements& needs, vulkan::MemoryUse use, vulkan::Allocation& out) {
    if (allocations++ == fails_at) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    // Never at an offset of 0, which a careless binding would take for granted.
    const VkDeviceSize offset = (end_ + 1 + needs.alignment - 1) / needs.alignment * needs.alignment;
    end_ = offset + needs.size;
    if (end_ > BYTES) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    live.insert(offset);
    out = {.memory = memory_, .offset = offset};
    if (use != vulkan::MemoryUse::device) out.mapped = mapped_ + offset;
    return VK_SUCCESS;
  }

  const vulkan::Device& device_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
  VkDeviceSize end_ = 0;
};

class HostMemory : public GpuTest {
 protected:
  static Result<vulkan::Culler> culler_in(Block& block, const char* method, std::vector<std::string> options = {}) {
    vulkan::Device device = test_context().device();
    device.memory_callbacks = block.callbacks();
    return vulkan::Culler::create(device, {.width = ENGINE_WIDTH,
                                           .height = ENGINE_HEIGHT,
                                           .light_capacity = ENGINE_LIGHTS,
                                           .method = method,
                                           .options = std::move(options)});
  }
};

TEST_F(HostMemory, HoldsEveryBufferOfACuller) {
  const EngineFrame frame = engine_frame();
  Block block(test_context().device());
  for (const char* method : {"lamplight", "tiled", "clustered", "drobot-zbin", "drobot-raster-tile"}) {
    SCOPED_TRACE(method);
    {
      vulkan::Culler culler = take(culler_in(block, method));
      EXPECT_GT(block.live.size(), 2);
      vulkan::Culler own = take(engine_culler(method));
      EXPECT_EQ(cull_and_walk(culler, frame), cull_and_walk(own, frame));
    }
    EXPECT_TRUE(block.live.empty());
  }
}

TEST_F(HostMemory, BuffersThatGrewComeBackWhenTheirFramesAreDone) {
  const EngineFrame frame = engine_frame();
  Block block(test_context().device());
  {
    vulkan::Culler culler = take(culler_in(block, "clustered", {"mean_capacity=1"}));
    const std::size_t before = block.live.size();
    const Masks first = cull_and_walk(culler, frame);
    expect_no_miss(frame, first);
    EXPECT_NE(take(culler.finish(1)), vulkan::Growth::none);
    EXPECT_GT(block.live.size(), before) << "the old ones are kept for frames under way";
    expect_no_miss(frame, cull_and_walk(culler, frame));
    EXPECT_EQ(take(culler.finish(2)), vulkan::Growth::none);
    EXPECT_EQ(block.live.size(), before);
  }
  EXPECT_TRUE(block.live.empty());
}

TEST_F(HostMemory, AnAllocationThatFailsIsTheErrorOfItsBuffer) {
  Block block(test_context().device());
  block.fails_at = 1;
  const Result<vulkan::Culler> culler = culler_in(block, "tiled");
  ASSERT_FALSE(culler.ok());
  EXPECT_NE(culler.error().text().find("buffer "), std::string::npos) << culler.error().text();
  EXPECT_NE(culler.error().text().find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos) << culler.error().text();
  EXPECT_TRUE(block.live.empty()) << "what was there before is given back";
}

TEST_F(HostMemory, MemoryThatIsNotMappedIsRefusedWhereTheHostReads) {
  vulkan::Device device = test_context().device();
  Block block(device);
  device.memory_callbacks = block.callbacks();
  const vulkan::BufferInfo info{
      .name = "counts", .bytes = 64, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT, .memory = vulkan::MemoryUse::readback};
  EXPECT_EQ(take(vulkan::Buffer::create(device, info)).mapped().size(), 64);
  static vulkan::MemoryCallbacks mapped;
  mapped = device.memory_callbacks;
  device.memory_callbacks.allocate = [](void* user, VkBuffer buffer, const VkMemoryRequirements& needs,
                                        vulkan::MemoryUse use, vulkan::Allocation& out) {
    const VkResult result = mapped.allocate(user, buffer, needs, use, out);
    out.mapped = nullptr;
    return result;
  };
  const auto buffer = vulkan::Buffer::create(device, info);
  ASSERT_FALSE(buffer.ok());
  EXPECT_EQ(buffer.error().text(), "buffer counts: expected mapped memory from MemoryCallbacks::allocate, got none");
  EXPECT_TRUE(block.live.empty());
}

TEST_F(HostMemory, HalfOfTheCallbacksAndMemoryThatIsNoneAreRefused) {
  vulkan::Device device = test_context().device();
  const vulkan::CullerInfo info{.width = 64, .height = 64, .light_capacity = 8, .method = "tiled"};
  device.memory_callbacks.allocate = [](void*, VkBuffer, const VkMemoryRequirements&, vulkan::MemoryUse,
                                        vulkan::Allocation&) { return VK_SUCCESS; };
  const auto half = vulkan::Culler::create(device, info);
  ASSERT_FALSE(half.ok());
  EXPECT_EQ(half.error().text(), "memory callbacks: expected both allocate and release, or neither");
  device.memory_callbacks.release = [](void*, const vulkan::Allocation&) {};
  const auto none = vulkan::Culler::create(device, info);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().text().find("expected memory from MemoryCallbacks::allocate, got null"), std::string::npos);
}

// A host keeps its cache between runs: every pipeline is looked for and kept there.
TEST_F(HostMemory, PipelinesAreMadeWithTheCacheOfTheHost) {
  vulkan::Device device = test_context().device();
  device.pipelines = nullptr;  // every pipeline anew
  const VkPipelineCacheCreateInfo create{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  ASSERT_EQ(vkCreatePipelineCache(device.handle, &create, nullptr, &device.pipeline_cache), VK_SUCCESS);
  static std::multiset<VkPipelineCache> compute;
  static std::multiset<VkPipelineCache> graphics;
  device.vk.vkCreateComputePipelines = [](VkDevice handle, VkPipelineCache cache, std::uint32_t count,
                                          const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* host,
                                          VkPipeline* made) {
    compute.insert(cache);
    return vkCreateComputePipelines(handle, cache, count, infos, host, made);
  };
  device.vk.vkCreateGraphicsPipelines = [](VkDevice handle, VkPipelineCache cache, std::uint32_t count,
                                           const VkGraphicsPipelineCreateInfo* infos, const VkAllocationCallbacks* host,
                                           VkPipeline* made) {
    graphics.insert(cache);
    return vkCreateGraphicsPipelines(handle, cache, count, infos, host, made);
  };
  static_cast<void>(take(vulkan::Culler::create(
      device, {.width = 64, .height = 64, .light_capacity = 64, .method = "drobot-raster-tile"})));
  EXPECT_GT(compute.size(), 0);
  EXPECT_GT(graphics.size(), 0);
  EXPECT_EQ(compute.count(device.pipeline_cache), compute.size());
  EXPECT_EQ(graphics.count(device.pipeline_cache), graphics.size());
  vkDestroyPipelineCache(device.handle, device.pipeline_cache, nullptr);
}

}  // namespace
}  // namespace lamp::app
