// Records, submits and waits, each when it is asked to.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/commands.h"

#include <limits>

namespace lamp::app {

Commands::Commands(const std::function<void(VkCommandBuffer)>& record) {
  const VkDevice device = test_context().device().handle;
  const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                          .queueFamilyIndex = test_context().queue_family()};
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "creating a command pool");
  pool_ = vulkan::OwnedCommandPool(device, pool, vkDestroyCommandPool);
  const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(device, &fence_info, nullptr, &fence), "creating a fence");
  fence_ = vulkan::OwnedFence(device, fence, vkDestroyFence);
  const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device, &allocate, &commands_), "allocating a command buffer");
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  check(vkBeginCommandBuffer(commands_, &begin), "beginning a command buffer");
  record(commands_);
  check(vkEndCommandBuffer(commands_), "ending a command buffer");
}

void Commands::submit() {
  const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                         .commandBuffer = commands_};
  const VkSubmitInfo2 submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer};
  check(vkQueueSubmit2(test_context().queue(), 1, &submit, fence_.get()), "submitting to the device");
}

void Commands::wait() const {
  const VkFence fence = fence_.get();
  check(vkWaitForFences(test_context().device().handle, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
        "waiting for the device");
}

}  // namespace lamp::app
