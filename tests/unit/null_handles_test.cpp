// What is created without a device or an instance is refused, in every build, before Vulkan is called.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "lamplight/vulkan.h"

namespace lamp::vulkan {
namespace {

constexpr const char* NO_DEVICE = "device: expected one that make_device gave, got null";
constexpr const char* NO_INSTANCE = "instance: expected one that load_instance gave, got null";

template <class T>
std::string error_of(const Result<T>& result) {
  return result ? "none" : result.error().text();
}

/// Of nothing, which no test reads.
template <class Handle>
Handle some() {
  static char object = 0;
  return reinterpret_cast<Handle>(&object);
}

PFN_vkVoidFunction knows_nothing(VkDevice, const char*) { return nullptr; }

/// As far as a null handle beside it is looked for.
Instance some_instance() {
  Instance instance{.handle = some<VkInstance>(), .api_version = VK_API_VERSION_1_3};
  instance.vk.vkGetDeviceProcAddr = knows_nothing;
  return instance;
}

TEST(NullHandles, OfInstancesAndDevicesAreErrors) {
  const auto physical = some<VkPhysicalDevice>();
  const auto device = some<VkDevice>();
  EXPECT_EQ(error_of(load_device(Instance(), device)), NO_INSTANCE);
  EXPECT_EQ(error_of(load_device(some_instance(), VK_NULL_HANDLE)), "device: expected a VkDevice, got null");
  EXPECT_TRUE(error_of(load_device(some_instance(), device)).starts_with("device: does not know the function"));
  ASSERT_TRUE(check_device(Instance(), physical));
  EXPECT_EQ(check_device(Instance(), physical)->text(), NO_INSTANCE);
  ASSERT_TRUE(check_device(some_instance(), VK_NULL_HANDLE));
  EXPECT_EQ(check_device(some_instance(), VK_NULL_HANDLE)->text(), "device: expected a VkPhysicalDevice, got null");
  EXPECT_EQ(error_of(make_device(Instance(), physical, device)), NO_INSTANCE);
  EXPECT_EQ(error_of(make_device(some_instance(), VK_NULL_HANDLE, device)),
            "device: expected a VkPhysicalDevice, got null");
  EXPECT_EQ(error_of(make_device(some_instance(), physical, VK_NULL_HANDLE)), "device: expected a VkDevice, got null");
}

TEST(NullHandles, HaveNoExtensionsAndTheLimitsOfNoDevice) {
  for (const auto& [instance, physical] : {std::pair(Instance(), some<VkPhysicalDevice>()),
                                           std::pair(some_instance(), VkPhysicalDevice{VK_NULL_HANDLE})}) {
    EXPECT_TRUE(useful_extensions(instance, physical).empty());
    EXPECT_FALSE(has_pipeline_robustness(instance, physical));
    EXPECT_EQ(traits_of(instance, physical).max_storage_buffer_bytes, DeviceTraits().max_storage_buffer_bytes);
  }
}

TEST(NullHandles, NothingIsCreatedOnNoDevice) {
  Device without_functions;
  without_functions.handle = some<VkDevice>();
  for (const Device& device : {Device(), without_functions}) {
    EXPECT_EQ(error_of(Culler::create(device, {.width = 64, .height = 64, .light_capacity = 10})), NO_DEVICE);
    EXPECT_EQ(error_of(PlanRunner::create(device, Plan())), NO_DEVICE);
    EXPECT_EQ(error_of(Buffer::create(device, {.name = "some", .bytes = 16})), NO_DEVICE);
    EXPECT_EQ(error_of(Timestamps::create(device, 4)), NO_DEVICE);
    EXPECT_EQ(error_of(Pipeline::compute(device, {}, {})), NO_DEVICE);
    EXPECT_EQ(error_of(Pipeline::graphics(device, {}, {}, {}, {})), NO_DEVICE);
    EXPECT_EQ(error_of(make_pipeline(device, {.name = "some", .shader = "methods/light_bounds"})), NO_DEVICE);
    EXPECT_FALSE(find_memory_type(device, ~0U, 0).ok());
    DescriptorSets sets(device);
    EXPECT_EQ(error_of(sets.allocate(Pipeline())),
              "descriptor sets: expected a device that make_device gave, got null");
    EXPECT_TRUE(sets.error().has_value());
    Device addressable = device;
    addressable.buffer_addresses = true;
    EXPECT_EQ(error_of(BoundLookUp().addresses(addressable)), NO_DEVICE);
  }
}

/// A device on which every buffer fails: for errors that come before the first.
Device full_device() {
  Device device;
  device.handle = some<VkDevice>();
  device.vk.vkCreateBuffer = [](VkDevice, const VkBufferCreateInfo*, const VkAllocationCallbacks*, VkBuffer*) {
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  };
  return device;
}

TEST(NullHandles, WhatCannotBeMadeIsNamedBeforeTheDeviceIsAsked) {
  const Device device = full_device();
  EXPECT_EQ(error_of(Buffer::create(device, {.name = "some"})), "buffer some: expected at least 1 byte, got 0");
  EXPECT_EQ(error_of(Timestamps::create(device, 0)), "timestamps: expected room for at least 1 pass, got 0");
  EXPECT_EQ(error_of(Pipeline::compute(device, {.name = "some"}, {})), "pipeline some: expected SPIR-V, got none");
  EXPECT_EQ(PlanRunner().buffer(PLAN_BUFFER + 1), VkBuffer(VK_NULL_HANDLE));
  Device addressable = device;
  addressable.buffer_addresses = true;
  EXPECT_EQ(
      error_of(BoundLookUp{.name = "some"}.addresses(addressable)),
      "look-up some: expected buffers made from a device that says Device::buffer_addresses, got some of one without");
}

TEST(StillLights, AreForMethodsThatReadThem) {
  const auto created = [](const char* method) {
    return error_of(Culler::create(
        full_device(), {.width = 64, .height = 64, .light_capacity = 10, .method = method, .still = some<VkBuffer>()}));
  };
  EXPECT_EQ(created("clustered"),
            "still lights: expected no buffer for method clustered, which reads none; world-tree does");
  EXPECT_TRUE(created("world-tree").starts_with("buffer ")) << created("world-tree");
}

}  // namespace
}  // namespace lamp::vulkan
