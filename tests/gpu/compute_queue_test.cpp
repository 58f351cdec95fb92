// Culling on a queue family without graphics: depth is handed to it from the graphics queue, the look-up's buffers are
// handed back. Where a device has no such family, the same runs on one queue, and handing over is nothing.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "gpu/dispatch.h"
#include "gpu/made_up_frame.h"
#include "gpu/test_scenes.h"
#include "lamplight/vulkan/culler.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WORDS = 11;  // of a pixel, in walks.comp
constexpr glm::uvec2 SIZE(85, 53);
constexpr std::uint32_t LIGHTS = 200;
constexpr float DEPTH = 0.02F;
constexpr VkImageSubresourceRange ALL_DEPTH{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};

struct Queue {
  std::uint32_t family = 0;
  VkQueue handle = VK_NULL_HANDLE;
  vulkan::OwnedCommandPool pool;
};

/// The family of the device that computes and does not draw; else the one that the tests use.
std::uint32_t compute_family() {
  std::uint32_t count = 0;
  const VkPhysicalDevice physical = test_context().device().physical;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  const auto found = std::ranges::find_if(families, [](const VkQueueFamilyProperties& family) {
    return (family.queueFlags & (VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT)) == VK_QUEUE_COMPUTE_BIT;
  });
  return found == families.end() ? test_context().queue_family() : static_cast<std::uint32_t>(found - families.begin());
}

class ComputeQueue : public GpuTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    const std::uint32_t families[] = {test_context().queue_family(), compute_family()};
    const float priority = 1.0F;
    std::vector<VkDeviceQueueCreateInfo> queues;
    for (const std::uint32_t family : families)
      if (queues.empty() || family != families[0])
        queues.push_back({.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                          .queueFamilyIndex = family,
                          .queueCount = 1,
                          .pQueuePriorities = &priority});
    const vulkan::Device& shared = test_context().device();
    const vulkan::RequiredFeatures features;
    const char* const push = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
    const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                    .pNext = &features.base,
                                    .queueCreateInfoCount = static_cast<std::uint32_t>(queues.size()),
                                    .pQueueCreateInfos = queues.data(),
                                    .enabledExtensionCount = shared.pushes_descriptors() ? 1U : 0U,
                                    .ppEnabledExtensionNames = &push};
    VkDevice handle = VK_NULL_HANDLE;
    check(vkCreateDevice(shared.physical, &create, nullptr, &handle), "creating a device");
    device_ = take(vulkan::make_device(test_context().instance(), shared.physical, handle));
    sets_ = vulkan::DescriptorSets(device_);
    device_.sets = &sets_;
    graphics_ = queue_of(families[0]);
    compute_ = queue_of(families[1]);
    RecordProperty("families", fmt::format("{} draws, {} computes", families[0], families[1]));
  }
  void TearDown() override {
    graphics_ = {};
    compute_ = {};
    sets_ = {};
    vkDestroyDevice(device_.handle, nullptr);
    GpuTest::TearDown();
  }

  [[nodiscard]] Queue queue_of(std::uint32_t family) const {
    Queue queue{.family = family};
    vkGetDeviceQueue(device_.handle, family, 0, &queue.handle);
    const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device_.handle, &info, nullptr, &pool), "creating a command pool");
    queue.pool = vulkan::OwnedCommandPool(device_.handle, pool, vkDestroyCommandPool);
    return queue;
  }

  [[nodiscard]] vulkan::Buffer mapped(const std::string& name, std::uint64_t bytes) const {
    return take(vulkan::Buffer::create(device_, {.name = name,
                                                 .bytes = bytes,
                                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                                 .memory = vulkan::MemoryUse::readback}));
  }

  void submit(const Queue& queue, VkSemaphore wait, VkSemaphore signal,
              const std::function<void(VkCommandBuffer)>& record) const {
    const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = queue.pool.get(),
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
    VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    check(vkAllocateCommandBuffers(device_.handle, &allocate, &commands.commandBuffer), "allocating commands");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands.commandBuffer, &begin), "beginning commands");
    record(commands.commandBuffer);
    check(vkEndCommandBuffer(commands.commandBuffer), "ending commands");
    const auto all = [](VkSemaphore semaphore) {
      return VkSemaphoreSubmitInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                   .semaphore = semaphore,
                                   .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    };
    const VkSemaphoreSubmitInfo waits = all(wait);
    const VkSemaphoreSubmitInfo signals = all(signal);
    const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                             .waitSemaphoreInfoCount = wait == VK_NULL_HANDLE ? 0U : 1U,
                             .pWaitSemaphoreInfos = &waits,
                             .commandBufferInfoCount = 1,
                             .pCommandBufferInfos = &commands,
                             .signalSemaphoreInfoCount = signal == VK_NULL_HANDLE ? 0U : 1U,
                             .pSignalSemaphoreInfos = &signals};
    check(vkQueueSubmit2(queue.handle, 1, &info, VK_NULL_HANDLE), "submitting to the device");
  }

  vulkan::Device device_;
  vulkan::DescriptorSets sets_;
  Queue graphics_, compute_;
};

void image_barrier(VkCommandBuffer commands, const VkImageMemoryBarrier2& barrier) {
  const VkDependencyInfo info{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &info);
}

/// From the graphics queue to one that computes; recorded on both. The same barrier moves the layout, once.
void hand_over_depth(VkCommandBuffer commands, VkImage image, const Queue& from, const Queue& to) {
  image_barrier(commands, {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                           .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                           .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                           .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                           .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT,
                           .oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           .newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                           .srcQueueFamilyIndex = from.family,
                           .dstQueueFamilyIndex = to.family,
                           .image = image,
                           .subresourceRange = ALL_DEPTH});
}

/// The look-up's buffers, as docs/integrating.md has it; nothing for queues of one family.
void hand_over(VkCommandBuffer commands, const vulkan::BoundLookUp& lookup, const Queue& from, const Queue& to) {
  if (from.family == to.family) return;
  std::vector<VkBufferMemoryBarrier2> barriers;
  for (const vulkan::Bound& bound : lookup.resources)
    barriers.push_back({.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT,
                        .srcQueueFamilyIndex = from.family,
                        .dstQueueFamilyIndex = to.family,
                        .buffer = bound.resource.buffer,
                        .size = VK_WHOLE_SIZE});
  const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .bufferMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                              .pBufferMemoryBarriers = barriers.data()};
  vkCmdPipelineBarrier2(commands, &info);
}

void clear_depth(VkCommandBuffer commands, VkImage image) {
  image_barrier(commands, {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                           .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                           .dstAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                           .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                           .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                           .image = image,
                           .subresourceRange = ALL_DEPTH});
  const VkClearDepthStencilValue value{DEPTH, 0};
  vkCmdClearDepthStencilImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &ALL_DEPTH);
}

class Semaphore {
 public:
  explicit Semaphore(VkDevice device) : device_(device) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    check(vkCreateSemaphore(device, &info, nullptr, &handle_), "creating a semaphore");
  }
  ~Semaphore() { vkDestroySemaphore(device_, handle_, nullptr); }
  Semaphore(const Semaphore&) = delete;
  Semaphore& operator=(const Semaphore&) = delete;

  [[nodiscard]] VkSemaphore handle() const { return handle_; }

 private:
  VkDevice device_;
  VkSemaphore handle_ = VK_NULL_HANDLE;
};

/// The words that a frame's look-up leaves at each pixel, of frames culled on one queue and read on another.
class ComputeQueueFrames : public ComputeQueue {
 protected:
  std::vector<std::uint32_t> words(const Queue& culls, std::uint32_t frames) {
    const View view = made_up_view(SIZE, 0.2);
    const std::vector<shared::Light> lights = scattered_lights(view, LIGHTS);
    const vulkan::Buffer light_buffer = mapped("lights", lights.size() * sizeof(shared::Light));
    std::memcpy(light_buffer.mapped().data(), lights.data(), light_buffer.bytes());
    const GpuImage depth(device_, {.name = "depth",
                                   .width = SIZE.x,
                                   .height = SIZE.y,
                                   .format = VK_FORMAT_D32_SFLOAT,
                                   .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    vulkan::Culler culler = take(vulkan::Culler::create(device_, {.width = SIZE.x,
                                                                  .height = SIZE.y,
                                                                  .light_capacity = LIGHTS,
                                                                  .method = GetParam(),
                                                                  .readers = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT}));
    const vulkan::BoundLookUp lookup = culler.lookup();
    vulkan::PipelineInfo info{
        .name = "walks", .constants = lookup.specialization({{0, 8}, {1, 8}}).constants, .bindings = {{0}, {1}}};
    for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
    const auto pipeline =
        take(vulkan::Pipeline::compute(device_, info, test_shader("walks@" + std::string(lookup.name))));
    const vulkan::Buffer found = mapped("words", std::uint64_t{SIZE.x} * SIZE.y * WORDS * sizeof(std::uint32_t));
    const Semaphore depth_drawn(device_.handle);
    const Semaphore culled(device_.handle);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      submit(graphics_, VK_NULL_HANDLE, depth_drawn.handle(), [&](VkCommandBuffer commands) {
        clear_depth(commands, depth.handle());
        hand_over_depth(commands, depth.handle(), graphics_, culls);
      });
      std::uint64_t recorded = 0;
      submit(culls, depth_drawn.handle(), culled.handle(), [&](VkCommandBuffer commands) {
        if (culls.family != graphics_.family) hand_over_depth(commands, depth.handle(), graphics_, culls);
        recorded = take(culler.record(commands, {.view = &view,
                                                 .lights = light_buffer.handle(),
                                                 .light_count = LIGHTS,
                                                 .depth_image = depth.handle(),
                                                 .depth_view = depth.view()}));
        hand_over(commands, lookup, culls, graphics_);
      });
      submit(graphics_, culled.handle(), VK_NULL_HANDLE, [&](VkCommandBuffer commands) {
        hand_over(commands, lookup, culls, graphics_);
        vulkan::AccessTracker tracker;
        vulkan::Recorder recorder(device_, commands, tracker);
        std::vector<vulkan::Bound> bound = lookup.resources;
        bound.push_back({0, lookup.resources.front().resource});
        bound.push_back({1, vulkan::Resource::storage(found.handle())});
        recorder.bind(pipeline, bound);
        vkCmdDispatch(commands, SIZE.x / 8 + 1, SIZE.y / 8 + 1, 1);
        recorder.order(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
      });
      check(vkDeviceWaitIdle(device_.handle), "waiting for the device");
      sets_.reset();
      EXPECT_EQ(take(culler.finish(recorded)), vulkan::Growth::none);
    }
    return contents<std::uint32_t>(found);
  }
};

TEST_P(ComputeQueueFrames, SayWhatTheGraphicsQueueSays) {
  const std::vector<std::uint32_t> expected = words(graphics_, 1);
  EXPECT_TRUE(std::ranges::any_of(expected, [](std::uint32_t word) { return word != 0; }));
  EXPECT_EQ(words(compute_, 2), expected);
}

INSTANTIATE_TEST_SUITE_P(Of, ComputeQueueFrames, ::testing::Values("tiled", "clustered", "lamplight", "drobot-zbin"),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace lamp::app
