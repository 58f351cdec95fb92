// The smallest program that uses Lamplight: a Culler on the first device, and the SPIR-V of a shader that includes its
// look-up. Exit code 0: headers, library and shaders are there and of one version.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/version.h>
#include <lamplight/vulkan.h>

#include <cstdio>
#include <string>

namespace {

constexpr std::uint32_t SHADER[] = {
#include "consumer.inc"
};

VkPhysicalDevice first_device(VkInstance instance) {
  std::uint32_t count = 1;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  vkEnumeratePhysicalDevices(instance, &count, &physical);
  return physical;
}

VkDevice make_device(const lamp::vulkan::Instance& instance, VkPhysicalDevice physical) {
  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue{
      .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
  const lamp::vulkan::RequiredFeatures features;
  const auto extensions = lamp::vulkan::useful_extensions(instance, physical);
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &features.base,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue,
                                .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                .ppEnabledExtensionNames = extensions.data()};
  VkDevice device = VK_NULL_HANDLE;
  vkCreateDevice(physical, &info, nullptr, &device);
  return device;
}

int fail(const char* what) {
  std::fprintf(stderr, "consumer: %s\n", what);
  return 1;
}

bool culls(const lamp::vulkan::Instance& instance, VkPhysicalDevice physical, VkDevice handle) {
  const auto device = lamp::vulkan::make_device(instance, physical, handle);
  if (!device) return false;
  const auto culler = lamp::vulkan::Culler::create(
      device.value(), {.width = 640, .height = 360, .light_capacity = 1000, .method = "clustered"});
  if (!culler) return false;
  std::printf("lamplight %s: %llu bytes, look-up %s, %zu words of a shader\n", lamp::version().data(),
              static_cast<unsigned long long>(culler.value().bytes()),
              std::string(culler.value().lookup().name).c_str(), sizeof(SHADER) / sizeof(SHADER[0]));
  return true;
}

}  // namespace

int main() {
  int major = 0;
  int minor = 0;
  if (std::sscanf(lamp::version().data(), "%d.%d", &major, &minor) != 2 || major != LAMPLIGHT_VERSION_MAJOR ||
      minor != LAMPLIGHT_VERSION_MINOR)
    return fail("the library is of another version than its headers");
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
  VkInstance instance = VK_NULL_HANDLE;
  if (vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS) return fail("no Vulkan instance");
  const auto loaded = lamp::vulkan::load_instance(vkGetInstanceProcAddr, instance, VK_API_VERSION_1_3);
  if (!loaded) return fail("an instance that Lamplight does not take");
  const VkPhysicalDevice physical = first_device(instance);
  if (physical == VK_NULL_HANDLE || lamp::vulkan::check_device(loaded.value(), physical))
    return fail("no device for Lamplight");
  const VkDevice device = make_device(loaded.value(), physical);
  if (device == VK_NULL_HANDLE) return fail("the device cannot be made");
  const bool good = culls(loaded.value(), physical, device);
  vkDestroyDevice(device, nullptr);
  vkDestroyInstance(instance, nullptr);
  return good ? 0 : fail("no Culler");
}
