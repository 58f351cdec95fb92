// Vulkan's functions as pointers under their own names: no example links a loader. volk does this for all of Vulkan.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>  // with VK_NO_PROTOTYPES, which CMake defines

// clang-format off
#define FOR_INSTANCE_FUNCTIONS(F) \
  F(vkCreateDebugUtilsMessengerEXT) F(vkCreateDevice) F(vkDestroyDebugUtilsMessengerEXT) F(vkDestroyInstance) \
  F(vkEnumeratePhysicalDevices) F(vkGetPhysicalDeviceMemoryProperties) F(vkGetPhysicalDeviceProperties) \
  F(vkGetPhysicalDeviceQueueFamilyProperties)
#define FOR_DEVICE_FUNCTIONS(F) \
  F(vkAllocateCommandBuffers) F(vkAllocateDescriptorSets) F(vkAllocateMemory) F(vkBeginCommandBuffer) \
  F(vkBindBufferMemory) F(vkBindImageMemory) F(vkCmdBeginRendering) F(vkCmdBindDescriptorSets) F(vkCmdBindPipeline) \
  F(vkCmdCopyBufferToImage) F(vkCmdCopyImageToBuffer) F(vkCmdDispatch) F(vkCmdDraw) F(vkCmdEndRendering) F(vkCmdFillBuffer) \
  F(vkCmdPipelineBarrier2) F(vkCmdPushConstants) F(vkCmdSetScissor) F(vkCmdSetViewport) F(vkCreateBuffer) \
  F(vkCreateCommandPool) F(vkCreateComputePipelines) F(vkCreateDescriptorPool) F(vkCreateDescriptorSetLayout) \
  F(vkCreateGraphicsPipelines) F(vkCreateImage) F(vkCreateImageView) F(vkCreatePipelineLayout) F(vkCreateSemaphore) \
  F(vkCreateShaderModule) F(vkDestroyBuffer) F(vkDestroyCommandPool) F(vkDestroyDescriptorPool) \
  F(vkDestroyDescriptorSetLayout) F(vkDestroyDevice) F(vkDestroyImage) F(vkDestroyImageView) F(vkDestroyPipeline) \
  F(vkDestroyPipelineLayout) F(vkDestroySemaphore) F(vkDestroyShaderModule) F(vkDeviceWaitIdle) \
  F(vkEndCommandBuffer) F(vkFreeMemory) F(vkGetBufferMemoryRequirements) F(vkGetDeviceQueue) \
  F(vkGetImageMemoryRequirements) F(vkMapMemory) F(vkQueueSubmit2) F(vkUpdateDescriptorSets)

#define DECLARE(name) extern PFN_##name name;
DECLARE(vkGetInstanceProcAddr)
FOR_INSTANCE_FUNCTIONS(DECLARE)
FOR_DEVICE_FUNCTIONS(DECLARE)
#undef DECLARE
// clang-format on
