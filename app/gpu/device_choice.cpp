// Ranks devices: discrete, integrated, virtual, software; only those that pass the library's check.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/device_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "error.h"
#include "system/letter_case.h"

namespace lamp::app {
namespace {

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return 3;
    default:
      return 4;
  }
}

constexpr const char* KINDS[] = {"discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"};

VkPhysicalDeviceType type_of(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  return properties.deviceType;
}

bool matches(std::string_view wanted, std::size_t index, const DeviceRow& row) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc{} && end == wanted.data() + wanted.size()) return number == index;
  return !std::ranges::search(row.name, wanted, {}, small_letter, small_letter).empty();
}

}  // namespace

DeviceRow describe(const vulkan::Instance& instance, VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &driver};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  const std::optional<lamp::Error> problem = vulkan::check_device(instance, physical);
  return {.name = properties.properties.deviceName,
          .kind = KINDS[rank(properties.properties.deviceType)],
          .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
          .problem = problem ? problem->message : ""};
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance, &count, devices.data());
  devices.resize(count);
  return devices;
}

VkPhysicalDevice choose_device(const vulkan::Instance& instance, std::string_view wanted) {
  const std::vector<VkPhysicalDevice> devices = physical_devices(instance.handle);
  if (devices.empty())
    throw Error("no Vulkan device: install a driver, for example the package mesa-vulkan-drivers", Exit::no_device);
  VkPhysicalDevice best = VK_NULL_HANDLE;
  std::string seen;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceRow row = describe(instance, devices[i]);
    seen += fmt::format("{}{} {}{}", i == 0 ? "" : "; ", i, row.name, row.problem.empty() ? "" : " " + row.problem);
    if (!row.problem.empty() || (!wanted.empty() && !matches(wanted, i, row))) continue;
    if (best == VK_NULL_HANDLE || rank(type_of(devices[i])) < rank(type_of(best))) best = devices[i];
  }
  if (best != VK_NULL_HANDLE) return best;
  if (wanted.empty()) throw Error("no usable Vulkan device, found: " + seen, Exit::no_device);
  throw Error(fmt::format("no usable Vulkan device matches '{}', found: {}", wanted, seen), Exit::no_device);
}

}  // namespace lamp::app
