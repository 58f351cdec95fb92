// Instance, device, queue and submission. Two lines are Lamplight's: the features it needs and the extensions it uses.
// SPDX-License-Identifier: Apache-2.0
#include "engine.h"

#include <lamplight/vulkan/device.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <stdexcept>
#include <string_view>

namespace {

constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";

VkBool32 receive(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/, VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                 const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
  return VK_FALSE;
}

bool has_validation() {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::ranges::any_of(layers,
                             [](const auto& layer) { return std::string_view(layer.layerName) == VALIDATION_LAYER; });
}

std::uint32_t graphics_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) return i;
  throw std::runtime_error("the device has no graphics queue");
}

}  // namespace

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + ": " + lamp::vulkan::result_text(result));
}

Engine::Engine() {
  create_instance();
  create_device();
}

void Engine::create_instance() {
  const VkApplicationInfo application{
      .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "small engine", .apiVersion = API_VERSION};
  const VkDebugUtilsMessengerCreateInfoEXT messenger{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = receive,
      .pUserData = &messages_};
  constexpr std::array ENABLED{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT validation{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .enabledValidationFeatureCount = ENABLED.size(),
                                           .pEnabledValidationFeatures = ENABLED.data()};
  constexpr std::array EXTENSIONS{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
  const bool validate = has_validation();
  if (validate) {
    create.pNext = &validation;
    create.enabledLayerCount = 1;
    create.ppEnabledLayerNames = &VALIDATION_LAYER;
    create.enabledExtensionCount = EXTENSIONS.size();
    create.ppEnabledExtensionNames = EXTENSIONS.data();
  }
  check(vkCreateInstance(&create, nullptr, &instance_), "creating an instance");
  if (!validate) return;
  const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  check(create_messenger(instance_, &messenger, nullptr, &messenger_), "creating a messenger");
}

void Engine::create_device() {
  std::uint32_t count = 1;
  vkEnumeratePhysicalDevices(instance_, &count, &physical_);
  if (count == 0) throw std::runtime_error("there is no Vulkan device");
  const auto loaded = lamp::vulkan::load_instance(vkGetInstanceProcAddr, instance_, API_VERSION);
  if (!loaded) throw std::runtime_error(loaded.error().text());
  loaded_ = loaded.value();
  if (const auto lack = lamp::vulkan::check_device(loaded_, physical_)) throw std::runtime_error(lack->text());

  const lamp::vulkan::RequiredFeatures features;  // an engine with features of its own sets these among them
  const auto extensions = lamp::vulkan::useful_extensions(loaded_, physical_);
  const std::uint32_t family = graphics_family(physical_);
  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = family,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.base,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
  check(vkCreateDevice(physical_, &create, nullptr, &device_), "creating a device");
  vkGetDeviceQueue(device_, family, 0, &queue_);
  push_descriptor_set_ =
      reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(vkGetDeviceProcAddr(device_, "vkCmdPushDescriptorSetKHR"));
  if (push_descriptor_set_ == nullptr) throw std::runtime_error("this engine pushes descriptors, the device does not");
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "creating a command pool");
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  check(vkCreateFence(device_, &fence, nullptr, &fence_), "creating a fence");
}

Engine::~Engine() {
  for (const auto& destroy : destroy_ | std::views::reverse) destroy();
  if (device_ != VK_NULL_HANDLE) {
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE)
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
}

std::string Engine::device_name() const {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical_, &properties);
  return properties.deviceName;
}

void Engine::submit(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferAllocateInfo allocate_info{
      .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool_, .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate_info, &commands), "allocating commands");
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  check(vkBeginCommandBuffer(commands, &begin), "beginning commands");
  record(commands);
  check(vkEndCommandBuffer(commands), "ending commands");
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  check(vkQueueSubmit(queue_, 1, &submit, fence_), "submitting");
  check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "waiting");
  check(vkResetFences(device_, 1, &fence_), "resetting a fence");
  vkFreeCommandBuffers(device_, pool_, 1, &commands);
}
