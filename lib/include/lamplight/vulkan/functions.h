// The Vulkan functions that Lamplight calls, under their own names. It links none of them: a host loads Vulkan as it
// likes (volk, VK_NO_PROTOTYPES, the linked loader), and its own `vk...` symbols cannot collide with the library's.
// Based on: Vulkan Memory Allocator's VmaVulkanFunctions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

#include "lamplight/error.h"
#include "lamplight/export.h"

namespace lamp::vulkan {

struct InstanceFunctions {
  PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties = nullptr;
  PFN_vkGetDeviceProcAddr vkGetDeviceProcAddr = nullptr;
  PFN_vkGetPhysicalDeviceFeatures2 vkGetPhysicalDeviceFeatures2 = nullptr;
  PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
  PFN_vkGetPhysicalDeviceProperties vkGetPhysicalDeviceProperties = nullptr;
  PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2 = nullptr;
};

struct DeviceFunctions {
  PFN_vkAllocateDescriptorSets vkAllocateDescriptorSets = nullptr;
  PFN_vkAllocateMemory vkAllocateMemory = nullptr;
  PFN_vkBindBufferMemory vkBindBufferMemory = nullptr;
  PFN_vkCmdBeginRendering vkCmdBeginRendering = nullptr;
  PFN_vkCmdBindDescriptorSets vkCmdBindDescriptorSets = nullptr;
  PFN_vkCmdBindPipeline vkCmdBindPipeline = nullptr;
  PFN_vkCmdCopyBuffer vkCmdCopyBuffer = nullptr;
  PFN_vkCmdDispatch vkCmdDispatch = nullptr;
  PFN_vkCmdDispatchIndirect vkCmdDispatchIndirect = nullptr;
  PFN_vkCmdDraw vkCmdDraw = nullptr;
  PFN_vkCmdDrawIndirect vkCmdDrawIndirect = nullptr;
  PFN_vkCmdEndRendering vkCmdEndRendering = nullptr;
  PFN_vkCmdFillBuffer vkCmdFillBuffer = nullptr;
  PFN_vkCmdPipelineBarrier2 vkCmdPipelineBarrier2 = nullptr;
  PFN_vkCmdResetQueryPool vkCmdResetQueryPool = nullptr;
  PFN_vkCmdSetScissor vkCmdSetScissor = nullptr;
  PFN_vkCmdSetViewport vkCmdSetViewport = nullptr;
  PFN_vkCmdUpdateBuffer vkCmdUpdateBuffer = nullptr;
  PFN_vkCmdWriteTimestamp2 vkCmdWriteTimestamp2 = nullptr;
  PFN_vkCreateBuffer vkCreateBuffer = nullptr;
  PFN_vkCreateComputePipelines vkCreateComputePipelines = nullptr;
  PFN_vkCreateDescriptorPool vkCreateDescriptorPool = nullptr;
  PFN_vkCreateDescriptorSetLayout vkCreateDescriptorSetLayout = nullptr;
  PFN_vkCreateGraphicsPipelines vkCreateGraphicsPipelines = nullptr;
  PFN_vkCreatePipelineLayout vkCreatePipelineLayout = nullptr;
  PFN_vkCreateQueryPool vkCreateQueryPool = nullptr;
  PFN_vkCreateSampler vkCreateSampler = nullptr;
  PFN_vkCreateShaderModule vkCreateShaderModule = nullptr;
  PFN_vkDestroyBuffer vkDestroyBuffer = nullptr;
  PFN_vkDestroyDescriptorPool vkDestroyDescriptorPool = nullptr;
  PFN_vkDestroyDescriptorSetLayout vkDestroyDescriptorSetLayout = nullptr;
  PFN_vkDestroyPipeline vkDestroyPipeline = nullptr;
  PFN_vkDestroyPipelineLayout vkDestroyPipelineLayout = nullptr;
  PFN_vkDestroyQueryPool vkDestroyQueryPool = nullptr;
  PFN_vkDestroySampler vkDestroySampler = nullptr;
  PFN_vkDestroyShaderModule vkDestroyShaderModule = nullptr;
  PFN_vkFreeMemory vkFreeMemory = nullptr;
  PFN_vkGetBufferDeviceAddress vkGetBufferDeviceAddress = nullptr;
  PFN_vkGetBufferMemoryRequirements vkGetBufferMemoryRequirements = nullptr;
  PFN_vkGetQueryPoolResults vkGetQueryPoolResults = nullptr;
  PFN_vkMapMemory vkMapMemory = nullptr;
  PFN_vkResetDescriptorPool vkResetDescriptorPool = nullptr;
  PFN_vkUpdateDescriptorSets vkUpdateDescriptorSets = nullptr;
  // Of extensions; null where a device or an instance was made without.
  PFN_vkCmdPushDescriptorSetKHR vkCmdPushDescriptorSetKHR = nullptr;
  PFN_vkGetPipelineExecutablePropertiesKHR vkGetPipelineExecutablePropertiesKHR = nullptr;
  PFN_vkGetPipelineExecutableStatisticsKHR vkGetPipelineExecutableStatisticsKHR = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;
  PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;
};

/// An instance that a host made, with what Lamplight calls of it. Plain; destroys nothing.
struct Instance {
  VkInstance handle = VK_NULL_HANDLE;
  std::uint32_t api_version = 0;  ///< VkApplicationInfo::apiVersion. A device does not know it, and one of 1.3 does no
                                  ///< more than 1.0 for an instance that asked for no more
  bool debug_utils = false;       ///< VK_EXT_debug_utils is enabled: objects get names, and passes labels
  InstanceFunctions vk;
};

/// `get`: the host's vkGetInstanceProcAddr, of the linked loader, of volk, or its own.
/// Errors: no instance, a function that `get` does not know, by its name.
[[nodiscard]] LAMPLIGHT_API Result<Instance> load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance,
                                                           std::uint32_t api_version);

/// Errors: an instance that is not `load_instance`'s, no device, a function of Vulkan 1.3 that the device does not
/// know, by its name.
[[nodiscard]] LAMPLIGHT_API Result<DeviceFunctions> load_device(const Instance& instance, VkDevice device);

}  // namespace lamp::vulkan
