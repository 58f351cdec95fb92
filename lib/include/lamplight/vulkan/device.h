// What Lamplight needs of a device, and what it knows of one that an engine already has.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/plan.h"
#include "lamplight/vulkan/functions.h"
#include "lamplight/vulkan/memory.h"

namespace lamp::vulkan {

/// The features to enable, chained for VkDeviceCreateInfo::pNext or to merge into an engine's own chain.
/// Vulkan 1.0: stores and atomics in fragment shaders. Later: scalar block layout, subgroup size control, full
/// subgroups, synchronization2, dynamic rendering, maintenance4.
struct LAMPLIGHT_API RequiredFeatures {
  /// VK_FALSE: none of them yet, for vkGetPhysicalDeviceFeatures2 to fill.
  explicit RequiredFeatures(VkBool32 enabled = VK_TRUE);
  RequiredFeatures(const RequiredFeatures&) = delete;
  RequiredFeatures& operator=(const RequiredFeatures&) = delete;

  VkPhysicalDeviceFeatures2 base{};
  VkPhysicalDeviceVulkan12Features vulkan12{};
  VkPhysicalDeviceVulkan13Features vulkan13{};
};

/// The device extensions to enable: none.
[[nodiscard]] LAMPLIGHT_API std::span<const char* const> required_extensions();

/// Device extensions that are used where they are enabled, as far as the device has them: VK_KHR_push_descriptor, and
/// for methods VK_EXT_conservative_rasterization. Who enables the latter says so in Device::traits
/// (`conservative_raster`). Without an instance of `load_instance` or without a device: none.
[[nodiscard]] LAMPLIGHT_API std::vector<const char*> useful_extensions(const Instance& instance,
                                                                       VkPhysicalDevice physical);

/// Whether the device has VK_EXT_pipeline_robustness and its feature. Who enables both says so in
/// Device::pipeline_robustness. Without an instance or a device: no.
[[nodiscard]] LAMPLIGHT_API bool has_pipeline_robustness(const Instance& instance, VkPhysicalDevice physical);

/// The name of the first of the required features that is VK_FALSE, or nothing.
[[nodiscard]] LAMPLIGHT_API std::optional<std::string_view> missing_feature(const RequiredFeatures& has);

/// Why this device cannot run Lamplight, naming the first missing version, feature or extension; or nothing. Errors
/// too: an instance that is not `load_instance`'s, no device.
[[nodiscard]] LAMPLIGHT_API std::optional<Error> check_device(const Instance& instance, VkPhysicalDevice physical);

/// Limits for planning. Without an instance or a device: DeviceTraits().
[[nodiscard]] LAMPLIGHT_API DeviceTraits traits_of(const Instance& instance, VkPhysicalDevice physical);

class DescriptorSets;
class PipelineStore;

/// An engine's device, with what recording needs at hand. Plain handles; destroys nothing. Whatever is created on one
/// that `make_device` did not make is an error.
struct LAMPLIGHT_API Device {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice handle = VK_NULL_HANDLE;
  DeviceFunctions vk;
  VkPhysicalDeviceMemoryProperties memory{};
  MemoryCallbacks memory_callbacks;                 ///< the host's allocator, if it wants to be asked
  VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  ///< the host's, not owned; where pipelines are looked for and kept
  DeviceTraits traits;
  float timestamp_period_ns = 1.0F;
  PipelineStore* pipelines = nullptr;  ///< not owned; where pipelines are shared, or null: each is made anew
  DescriptorSets* sets = nullptr;      ///< not owned; where Recorder::bind takes sets from if it cannot push
                                       ///< descriptors. Passes of a plan have sets of their own
  bool pipeline_statistics = false;    ///< VK_KHR_pipeline_executable_properties and its feature are enabled, and
                                       ///< pipelines shall be compiled so that the driver can describe them
  bool pipeline_robustness = false;    ///< VK_EXT_pipeline_robustness and its feature are enabled: pipelines then say
                                       ///< that they stay within their buffers, and a driver leaves out its checks
  bool buffer_addresses = false;       ///< the feature bufferDeviceAddress is enabled, and buffers that are made from
                                       ///< now on shall have addresses (BoundLookUp::addresses)

  /// A buffer's usage, with what its address needs.
  [[nodiscard]] VkBufferUsageFlags addressable(VkBufferUsageFlags usage) const {
    constexpr VkBufferUsageFlags ADDRESS = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    return buffer_addresses ? usage | ADDRESS : usage;
  }

  /// Whether descriptors are pushed: VK_KHR_push_descriptor is enabled, and nobody cleared its function. Else they lie
  /// in sets. Pipelines are made for one or the other.
  [[nodiscard]] bool pushes_descriptors() const { return vk.vkCmdPushDescriptorSetKHR != nullptr; }

  /// Gives an object its debug name, where the instance has VK_EXT_debug_utils.
  void name(VkObjectType type, std::uint64_t object, std::string_view text) const;
};

/// Errors: `check_device`'s, no device, or a function that it does not know.
[[nodiscard]] LAMPLIGHT_API Result<Device> make_device(const Instance& instance, VkPhysicalDevice physical,
                                                       VkDevice device);

/// The index of a memory type with all of `wanted`, preferring one that also has `preferred`.
[[nodiscard]] LAMPLIGHT_API Result<std::uint32_t> find_memory_type(const Device& device, std::uint32_t type_bits,
                                                                   VkMemoryPropertyFlags wanted,
                                                                   VkMemoryPropertyFlags preferred = 0);

/// The name of a result for error lines ("VK_ERROR_OUT_OF_DEVICE_MEMORY").
[[nodiscard]] LAMPLIGHT_API std::string result_text(VkResult result);

}  // namespace lamp::vulkan
