// Loads functions by their names.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/functions.h"

#include <string>

#include "null_handles.h"
#include "version_text.h"

namespace lamp::vulkan {
namespace {

/// Fills pointers by name, and keeps the first name that nobody knows.
template <class Get, class Owner>
class Loader {
 public:
  Loader(Get get, Owner owner) : get_(get), owner_(owner) {}

  template <class Function>
  void required(const char* name, Function& out) {
    optional(name, out);
    if (out == nullptr && missing_ == nullptr) missing_ = name;
  }
  template <class Function>
  void optional(const char* name, Function& out) {
    out = reinterpret_cast<Function>(get_(owner_, name));
  }
  [[nodiscard]] const char* missing() const { return missing_; }

 private:
  Get get_;
  Owner owner_;
  const char* missing_ = nullptr;
};

Error not_there(const char* owner, const char* name) {
  return {owner, std::string("does not know the function ") + name + "; expected Vulkan 1.3"};
}

}  // namespace

Result<Instance> load_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance, std::uint32_t api_version) {
  if (get == nullptr || instance == VK_NULL_HANDLE)
    return Error{"instance", "expected an instance and vkGetInstanceProcAddr, got null"};
  if (api_version < VK_API_VERSION_1_3)
    return Error{"instance", "needs Vulkan 1.3 as VkApplicationInfo::apiVersion, was made with " +
                                 version_text(api_version == 0 ? VK_API_VERSION_1_0 : api_version)};
  Instance loaded{.handle = instance, .api_version = api_version};
  InstanceFunctions& vk = loaded.vk;
  Loader loader(get, instance);
  loader.required("vkEnumerateDeviceExtensionProperties", vk.vkEnumerateDeviceExtensionProperties);
  loader.required("vkGetDeviceProcAddr", vk.vkGetDeviceProcAddr);
  loader.required("vkGetPhysicalDeviceFeatures2", vk.vkGetPhysicalDeviceFeatures2);
  loader.required("vkGetPhysicalDeviceMemoryProperties", vk.vkGetPhysicalDeviceMemoryProperties);
  loader.required("vkGetPhysicalDeviceProperties", vk.vkGetPhysicalDeviceProperties);
  loader.required("vkGetPhysicalDeviceProperties2", vk.vkGetPhysicalDeviceProperties2);
  if (loader.missing() != nullptr) return not_there("instance", loader.missing());
  // Of a device, layers know the extension's functions whether it is enabled or not.
  PFN_vkCreateDebugUtilsMessengerEXT create_messenger = nullptr;
  loader.optional("vkCreateDebugUtilsMessengerEXT", create_messenger);
  loaded.debug_utils = create_messenger != nullptr;
  return loaded;
}

Result<DeviceFunctions> load_device(const Instance& instance, VkDevice device) {
  if (auto error = check_loaded(instance)) return *error;
  if (auto error = check_handle(device)) return *error;
  DeviceFunctions vk;
  Loader loader(instance.vk.vkGetDeviceProcAddr, device);
  loader.required("vkAllocateDescriptorSets", vk.vkAllocateDescriptorSets);
  loader.required("vkAllocateMemory", vk.vkAllocateMemory);
  loader.required("vkBindBufferMemory", vk.vkBindBufferMemory);
  loader.required("vkCmdBeginRendering", vk.vkCmdBeginRendering);
  loader.required("vkCmdBindDescriptorSets", vk.vkCmdBindDescriptorSets);
  loader.required("vkCmdBindPipeline", vk.vkCmdBindPipeline);
  loader.required("vkCmdCopyBuffer", vk.vkCmdCopyBuffer);
  loader.required("vkCmdDispatch", vk.vkCmdDispatch);
  loader.required("vkCmdDispatchIndirect", vk.vkCmdDispatchIndirect);
  loader.required("vkCmdDraw", vk.vkCmdDraw);
  loader.required("vkCmdDrawIndirect", vk.vkCmdDrawIndirect);
  loader.required("vkCmdEndRendering", vk.vkCmdEndRendering);
  loader.required("vkCmdFillBuffer", vk.vkCmdFillBuffer);
  loader.required("vkCmdPipelineBarrier2", vk.vkCmdPipelineBarrier2);
  loader.required("vkCmdResetQueryPool", vk.vkCmdResetQueryPool);
  loader.required("vkCmdSetScissor", vk.vkCmdSetScissor);
  loader.required("vkCmdSetViewport", vk.vkCmdSetViewport);
  loader.required("vkCmdUpdateBuffer", vk.vkCmdUpdateBuffer);
  loader.required("vkCmdWriteTimestamp2", vk.vkCmdWriteTimestamp2);
  loader.required("vkCreateBuffer", vk.vkCreateBuffer);
  loader.required("vkCreateComputePipelines", vk.vkCreateComputePipelines);
  loader.required("vkCreateDescriptorPool", vk.vkCreateDescriptorPool);
  loader.required("vkCreateDescriptorSetLayout", vk.vkCreateDescriptorSetLayout);
  loader.required("vkCreateGraphicsPipelines", vk.vkCreateGraphicsPipelines);
  loader.required("vkCreatePipelineLayout", vk.vkCreatePipelineLayout);
  loader.required("vkCreateQueryPool", vk.vkCreateQueryPool);
  loader.required("vkCreateSampler", vk.vkCreateSampler);
  loader.required("vkCreateShaderModule", vk.vkCreateShaderModule);
  loader.required("vkDestroyBuffer", vk.vkDestroyBuffer);
  loader.required("vkDestroyDescriptorPool", vk.vkDestroyDescriptorPool);
  loader.required("vkDestroyDescriptorSetLayout", vk.vkDestroyDescriptorSetLayout);
  loader.required("vkDestroyPipeline", vk.vkDestroyPipeline);
  loader.required("vkDestroyPipelineLayout", vk.vkDestroyPipelineLayout);
  loader.required("vkDestroyQueryPool", vk.vkDestroyQueryPool);
  loader.required("vkDestroySampler", vk.vkDestroySampler);
  loader.required("vkDestroyShaderModule", vk.vkDestroyShaderModule);
  loader.required("vkFreeMemory", vk.vkFreeMemory);
  loader.required("vkGetBufferDeviceAddress", vk.vkGetBufferDeviceAddress);
  loader.required("vkGetBufferMemoryRequirements", vk.vkGetBufferMemoryRequirements);
  loader.required("vkGetQueryPoolResults", vk.vkGetQueryPoolResults);
  loader.required("vkMapMemory", vk.vkMapMemory);
  loader.required("vkResetDescriptorPool", vk.vkResetDescriptorPool);
  loader.required("vkUpdateDescriptorSets", vk.vkUpdateDescriptorSets);
  loader.optional("vkCmdPushDescriptorSetKHR", vk.vkCmdPushDescriptorSetKHR);
  loader.optional("vkGetPipelineExecutablePropertiesKHR", vk.vkGetPipelineExecutablePropertiesKHR);
  loader.optional("vkGetPipelineExecutableStatisticsKHR", vk.vkGetPipelineExecutableStatisticsKHR);
  if (instance.debug_utils) {
    loader.optional("vkCmdBeginDebugUtilsLabelEXT", vk.vkCmdBeginDebugUtilsLabelEXT);
    loader.optional("vkCmdEndDebugUtilsLabelEXT", vk.vkCmdEndDebugUtilsLabelEXT);
    loader.optional("vkSetDebugUtilsObjectNameEXT", vk.vkSetDebugUtilsObjectNameEXT);
  }
  if (loader.missing() != nullptr) return not_there("device", loader.missing());
  return vk;
}

}  // namespace lamp::vulkan
