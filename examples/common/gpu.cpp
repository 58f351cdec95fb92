// The device, its queues, memory, submission.
// SPDX-License-Identifier: Apache-2.0
#include "gpu.h"

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <ranges>
#include <stdexcept>

#define DEFINE(name) PFN_##name name = nullptr;
DEFINE(vkGetInstanceProcAddr)
FOR_INSTANCE_FUNCTIONS(DEFINE)
FOR_DEVICE_FUNCTIONS(DEFINE)

namespace {

VkBool32 receive(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/, VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                 const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
  return VK_FALSE;
}

Queue make_queue(VkDevice device, std::uint32_t family) {
  Queue queue{.family = family};
  vkGetDeviceQueue(device, family, 0, &queue.handle);
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, .queueFamilyIndex = family};
  check(vkCreateCommandPool(device, &pool, nullptr, &queue.pool), "creating a command pool");
  return queue;
}

}  // namespace

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + ": VkResult " + std::to_string(result));
}

Gpu::Gpu(bool validate) {
  void* loader = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (loader == nullptr) throw std::runtime_error("there is no Vulkan loader");
  vkGetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loader, "vkGetInstanceProcAddr"));
  const auto vkCreateInstance =
      reinterpret_cast<PFN_vkCreateInstance>(vkGetInstanceProcAddr(nullptr, "vkCreateInstance"));
  constexpr const char* LAYER = "VK_LAYER_KHRONOS_validation";
  constexpr std::array EXTENSIONS{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
  constexpr std::array ENABLED{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkDebugUtilsMessengerCreateInfoEXT messenger{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = receive,
      .pUserData = &messages_};
  const VkValidationFeaturesEXT validation{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger,
                                           .enabledValidationFeatureCount = ENABLED.size(),
                                           .pEnabledValidationFeatures = ENABLED.data()};
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
  VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &application};
  if (validate) {
    info.pNext = &validation;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &LAYER;
    info.enabledExtensionCount = EXTENSIONS.size();
    info.ppEnabledExtensionNames = EXTENSIONS.data();
  }
  check(vkCreateInstance(&info, nullptr, &instance), "creating an instance");
#define LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetInstanceProcAddr(instance, #name));
  FOR_INSTANCE_FUNCTIONS(LOAD)
  FOR_DEVICE_FUNCTIONS(LOAD)
  if (validate) check(vkCreateDebugUtilsMessengerEXT(instance, &messenger, nullptr, &messenger_), "a messenger");
  std::uint32_t count = 1;
  vkEnumeratePhysicalDevices(instance, &count, &physical);
  if (count == 0) throw std::runtime_error("there is no Vulkan device");
}

void Gpu::make_device(const VkPhysicalDeviceFeatures2& features, std::span<const char* const> extensions) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  const auto find = [&](VkQueueFlags flags) {
    std::uint32_t i = 0;
    while (i < count && (families[i].queueFlags & (VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT)) != flags) ++i;
    return i;
  };
  const std::uint32_t drawing = find(VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT);
  const std::uint32_t computing = find(VK_QUEUE_COMPUTE_BIT);
  if (drawing == count) throw std::runtime_error("the device has no graphics queue");
  const float priority = 1.0F;
  std::vector<VkDeviceQueueCreateInfo> queues;
  for (const std::uint32_t family : {drawing, computing})
    if (family < count)
      queues.push_back({.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                        .queueFamilyIndex = family,
                        .queueCount = 1,
                        .pQueuePriorities = &priority});
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &features,
                                .queueCreateInfoCount = static_cast<std::uint32_t>(queues.size()),
                                .pQueueCreateInfos = queues.data(),
                                .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                .ppEnabledExtensionNames = extensions.data()};
  const VkResult result = vkCreateDevice(physical, &info, nullptr, &device);
  if (result == VK_ERROR_FEATURE_NOT_PRESENT) throw LacksFeature("the device lacks a feature that this example shows");
  check(result, "creating a device");
  graphics = compute = make_queue(device, drawing);
  if (computing < count) compute = make_queue(device, computing);
}

Gpu::~Gpu() {
  for (const auto& destroy : destroy_ | std::views::reverse) destroy();
  if (device != VK_NULL_HANDLE) {
    vkDestroyCommandPool(device, graphics.pool, nullptr);
    if (compute.pool != graphics.pool) vkDestroyCommandPool(device, compute.pool, nullptr);
    vkDestroyDevice(device, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(instance, messenger_, nullptr);
  if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  std::uint32_t type = 0;
  while (type < memory.memoryTypeCount && ((needs.memoryTypeBits >> type & 1U) == 0 ||
                                           (memory.memoryTypes[type].propertyFlags & properties) != properties))
    ++type;
  if (type == memory.memoryTypeCount) throw std::runtime_error("the device has no such memory");
  const VkMemoryAllocateInfo info{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  check(vkAllocateMemory(device, &info, nullptr, &allocated), "allocating memory");
  destroy_.emplace_back([=, this] { vkFreeMemory(device, allocated, nullptr); });
  return allocated;
}

Buffer Gpu::make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) {
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
  Buffer buffer;
  check(vkCreateBuffer(device, &info, nullptr, &buffer.handle), "creating a buffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device, buffer.handle, &needs);
  const auto memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  destroy_.emplace_back([this, handle = buffer.handle] { vkDestroyBuffer(device, handle, nullptr); });
  check(vkBindBufferMemory(device, buffer.handle, memory, 0), "binding a buffer");
  void* mapped = nullptr;
  check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping a buffer");
  buffer.bytes = {static_cast<std::byte*>(mapped), bytes};
  return buffer;
}

Image Gpu::make_image(const ImageInfo& info) {
  const VkImageCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = info.format,
                                 .extent = {info.size.width, info.size.height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = info.layers,
                                 .samples = info.samples,
                                 .usage = info.usage};
  const bool depth = (info.usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
  Image image{.aspect = depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT, .size = info.size};
  check(vkCreateImage(device, &create, nullptr, &image.handle), "creating an image");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device, image.handle, &needs);
  const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  destroy_.emplace_back([this, handle = image.handle] { vkDestroyImage(device, handle, nullptr); });
  check(vkBindImageMemory(device, image.handle, memory, 0), "binding an image");
  const auto make_view = [&](VkImageViewType type, std::uint32_t first, std::uint32_t layers) {
    const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                          .image = image.handle,
                                          .viewType = type,
                                          .format = info.format,
                                          .subresourceRange = {image.aspect, 0, 1, first, layers}};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device, &view_info, nullptr, &view), "creating a view");
    destroy_.emplace_back([=, this] { vkDestroyImageView(device, view, nullptr); });
    return view;
  };
  image.view = make_view(info.layers == 1 ? VK_IMAGE_VIEW_TYPE_2D : VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, info.layers);
  for (std::uint32_t i = 0; i < info.layers; ++i) image.layer_views.push_back(make_view(VK_IMAGE_VIEW_TYPE_2D, i, 1));
  return image;
}

VkSemaphore Gpu::make_semaphore() {
  const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "creating a semaphore");
  destroy_.emplace_back([=, this] { vkDestroySemaphore(device, semaphore, nullptr); });
  return semaphore;
}

void Gpu::submit(const Queue& queue, const std::function<void(VkCommandBuffer)>& record, VkSemaphore wait_for,
                 VkSemaphore signal) {
  VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  const VkCommandBufferAllocateInfo allocate{
      .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = queue.pool, .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device, &allocate, &commands.commandBuffer), "allocating commands");
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  check(vkBeginCommandBuffer(commands.commandBuffer, &begin), "beginning commands");
  record(commands.commandBuffer);
  barrier(commands.commandBuffer);
  check(vkEndCommandBuffer(commands.commandBuffer), "ending commands");
  const auto all = [](VkSemaphore semaphore) {
    return VkSemaphoreSubmitInfo{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                 .semaphore = semaphore,
                                 .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
  };
  const VkSemaphoreSubmitInfo waits = all(wait_for);
  const VkSemaphoreSubmitInfo signals = all(signal);
  const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .waitSemaphoreInfoCount = wait_for == VK_NULL_HANDLE ? 0U : 1U,
                           .pWaitSemaphoreInfos = &waits,
                           .commandBufferInfoCount = 1,
                           .pCommandBufferInfos = &commands,
                           .signalSemaphoreInfoCount = signal == VK_NULL_HANDLE ? 0U : 1U,
                           .pSignalSemaphoreInfos = &signals};
  check(vkQueueSubmit2(queue.handle, 1, &info, VK_NULL_HANDLE), "submitting");
}

bool Gpu::quiet() const {
  for (const std::string& message : messages_) std::fprintf(stderr, "%s\n", message.c_str());
  return messages_.empty();
}

void Gpu::wait() { check(vkDeviceWaitIdle(device), "waiting"); }
