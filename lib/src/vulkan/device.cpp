// Requirements, limits and entry points of a device.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/device.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "null_handles.h"
#include "version_text.h"

namespace lamp::vulkan {
namespace {

constexpr std::array USEFUL{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME, VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME};

bool is_there(const Instance& instance, VkPhysicalDevice physical) {
  return !check_loaded(instance) && physical != VK_NULL_HANDLE;
}

bool has_extension(const Instance& instance, VkPhysicalDevice physical, std::string_view name) {
  if (!is_there(instance, physical)) return false;
  std::uint32_t count = 0;
  instance.vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  instance.vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::ranges::any_of(extensions, [&](const auto& e) { return name == e.extensionName; });
}

/// Calls `function(feature, name)` for each feature that Lamplight needs.
template <class Features, class Function>
void for_each_feature(Features& features, Function function) {
  function(features.vulkan12.scalarBlockLayout, "scalarBlockLayout");
  function(features.vulkan13.subgroupSizeControl, "subgroupSizeControl");
  function(features.vulkan13.computeFullSubgroups, "computeFullSubgroups");
  function(features.vulkan13.synchronization2, "synchronization2");
  function(features.vulkan13.dynamicRendering, "dynamicRendering");
  function(features.vulkan13.maintenance4, "maintenance4");
  function(features.base.features.fragmentStoresAndAtomics, "fragmentStoresAndAtomics");
}

}  // namespace

RequiredFeatures::RequiredFeatures(VkBool32 enabled) {
  vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  vulkan12.pNext = &vulkan13;
  base.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  base.pNext = &vulkan12;
  for_each_feature(*this, [&](VkBool32& feature, std::string_view /*name*/) { feature = enabled; });
}

std::optional<std::string_view> missing_feature(const RequiredFeatures& has) {
  std::optional<std::string_view> missing;
  for_each_feature(has, [&](VkBool32 feature, std::string_view name) {
    if (feature == VK_FALSE && !missing) missing = name;
  });
  return missing;
}

std::span<const char* const> required_extensions() { return {}; }

std::vector<const char*> useful_extensions(const Instance& instance, VkPhysicalDevice physical) {
  std::vector<const char*> extensions;
  for (const char* extension : USEFUL)
    if (has_extension(instance, physical, extension)) extensions.push_back(extension);
  return extensions;
}

bool has_pipeline_robustness(const Instance& instance, VkPhysicalDevice physical) {
  if (!has_extension(instance, physical, VK_EXT_PIPELINE_ROBUSTNESS_EXTENSION_NAME)) return false;
  VkPhysicalDevicePipelineRobustnessFeaturesEXT has{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_ROBUSTNESS_FEATURES_EXT};
  VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &has};
  instance.vk.vkGetPhysicalDeviceFeatures2(physical, &features);
  return has.pipelineRobustness == VK_TRUE;
}

std::optional<Error> check_device(const Instance& instance, VkPhysicalDevice physical) {
  if (auto error = check_loaded(instance)) return error;
  if (physical == VK_NULL_HANDLE) return Error{"device", "expected a VkPhysicalDevice, got null"};
  VkPhysicalDeviceProperties properties{};
  instance.vk.vkGetPhysicalDeviceProperties(physical, &properties);
  const std::string source = "device " + std::string(properties.deviceName);
  if (properties.apiVersion < VK_API_VERSION_1_3)
    return Error{source, "needs Vulkan 1.3, has " + version_text(properties.apiVersion)};
  RequiredFeatures has(VK_FALSE);
  instance.vk.vkGetPhysicalDeviceFeatures2(physical, &has.base);
  if (const auto missing = missing_feature(has)) return Error{source, "lacks the feature " + std::string(*missing)};
  return std::nullopt;
}

namespace {

std::uint64_t largest_heap(const Instance& instance, VkPhysicalDevice physical) {
  VkPhysicalDeviceMemoryProperties memory{};
  instance.vk.vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  std::uint64_t bytes = 0;
  for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount))
    if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) bytes = std::max(bytes, heap.size);
  return bytes;
}

SubgroupOperations operations_of(const VkPhysicalDeviceVulkan11Properties& properties, VkShaderStageFlagBits stage) {
  if ((properties.subgroupSupportedStages & stage) == 0) return {};
  const auto has = [&](VkSubgroupFeatureFlagBits bit) { return (properties.subgroupSupportedOperations & bit) != 0; };
  return {.vote = has(VK_SUBGROUP_FEATURE_VOTE_BIT),
          .ballot = has(VK_SUBGROUP_FEATURE_BALLOT_BIT),
          .arithmetic = has(VK_SUBGROUP_FEATURE_ARITHMETIC_BIT),
          .shuffle = has(VK_SUBGROUP_FEATURE_SHUFFLE_BIT),
          .shuffle_relative = has(VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT)};
}

}  // namespace

DeviceTraits traits_of(const Instance& instance, VkPhysicalDevice physical) {
  if (!is_there(instance, physical)) return {};
  constexpr std::uint32_t LLVMPIPE_LOOP_ROUNDS = 65535;  // LP_MAX_TGSI_LOOP_ITERATIONS of Mesa
  VkPhysicalDeviceVulkan13Properties v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES};
  VkPhysicalDeviceVulkan12Properties v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES,
                                         .pNext = &v13};
  VkPhysicalDeviceVulkan11Properties v11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                         .pNext = &v12};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &v11};
  instance.vk.vkGetPhysicalDeviceProperties2(physical, &properties);
  const VkPhysicalDeviceLimits& limits = properties.properties.limits;
  return {.max_storage_buffer_bytes = limits.maxStorageBufferRange,
          .memory_bytes = largest_heap(instance, physical),
          .max_groups = {limits.maxComputeWorkGroupCount[0], limits.maxComputeWorkGroupCount[1],
                         limits.maxComputeWorkGroupCount[2]},
          .max_group_invocations = limits.maxComputeWorkGroupInvocations,
          .shared_memory_bytes = limits.maxComputeSharedMemorySize,
          .max_image_size = limits.maxImageDimension2D,
          .max_storage_buffers = limits.maxPerStageDescriptorStorageBuffers,
          .storage_offset_alignment = static_cast<std::uint32_t>(limits.minStorageBufferOffsetAlignment),
          .subgroup_size = v11.subgroupSize,
          .max_subgroup_size = std::max(v11.subgroupSize, v13.maxSubgroupSize),
          .max_loop_rounds = v12.driverID == VK_DRIVER_ID_MESA_LLVMPIPE ? LLVMPIPE_LOOP_ROUNDS : ~0U,
          .compute_subgroups = operations_of(v11, VK_SHADER_STAGE_COMPUTE_BIT),
          .fragment_subgroups = operations_of(v11, VK_SHADER_STAGE_FRAGMENT_BIT),
          .sub_pixel_bits = limits.subPixelPrecisionBits};
}

void Device::name(VkObjectType type, std::uint64_t object, std::string_view text) const {
  if (vk.vkSetDebugUtilsObjectNameEXT == nullptr) return;
  const std::string terminated(text);
  const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                           .objectType = type,
                                           .objectHandle = object,
                                           .pObjectName = terminated.c_str()};
  vk.vkSetDebugUtilsObjectNameEXT(handle, &info);
}

Result<Device> make_device(const Instance& instance, VkPhysicalDevice physical, VkDevice handle) {
  if (auto error = check_handle(handle)) return *error;
  if (auto error = check_device(instance, physical)) return *error;
  const Result<DeviceFunctions> functions = load_device(instance, handle);
  if (!functions) return functions.error();
  Device device{
      .physical = physical, .handle = handle, .vk = functions.value(), .traits = traits_of(instance, physical)};
  instance.vk.vkGetPhysicalDeviceMemoryProperties(physical, &device.memory);
  VkPhysicalDeviceProperties properties{};
  instance.vk.vkGetPhysicalDeviceProperties(physical, &properties);
  device.timestamp_period_ns = properties.limits.timestampPeriod;
  return device;
}

Result<std::uint32_t> find_memory_type(const Device& device, std::uint32_t type_bits, VkMemoryPropertyFlags wanted,
                                       VkMemoryPropertyFlags preferred) {
  for (const VkMemoryPropertyFlags flags : {wanted | preferred, wanted})
    for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i)
      if ((type_bits >> i & 1U) != 0 && (device.memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
  return Error{"memory", "the device has no memory type with the properties " + std::to_string(wanted)};
}

std::string result_text(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory (VK_ERROR_OUT_OF_HOST_MEMORY)";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory (VK_ERROR_OUT_OF_DEVICE_MEMORY)";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost (VK_ERROR_DEVICE_LOST)";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "there is no Vulkan driver (VK_ERROR_INCOMPATIBLE_DRIVER)";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is missing (VK_ERROR_FEATURE_NOT_PRESENT)";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is missing (VK_ERROR_EXTENSION_NOT_PRESENT)";
    default:
      return "Vulkan error " + std::to_string(result);
  }
}

}  // namespace lamp::vulkan
