// Makes instance and device, submits, collects validation messages.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "gpu/check.h"
#include "gpu/device_choice.h"

namespace lamp::app {
namespace {

constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";

bool has_layer(std::string_view name) {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::ranges::any_of(layers, [&](const auto& layer) { return name == layer.layerName; });
}

bool has_debug_utils(const char* layer) {
  std::uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  return std::ranges::any_of(extensions, [](const auto& extension) {
    return std::string_view(extension.extensionName) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  });
}

vulkan::Instance make_instance(ContextInfo::Validation validation, std::span<const char* const> more = {}) {
  const VkApplicationInfo application{
      .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pApplicationName = "lamp", .apiVersion = INSTANCE_VERSION};
  constexpr std::array FEATURES{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .enabledValidationFeatureCount = FEATURES.size(),
                                         .pEnabledValidationFeatures = FEATURES.data()};
  const bool validate = validation == ContextInfo::Validation::on;
  if (validate && !has_layer(VALIDATION_LAYER))
    throw Error("validation was asked for but the layer is missing: install vulkan-validationlayers", Exit::no_device);
  std::vector<const char*> layers;
  std::vector<const char*> extensions(more.begin(), more.end());
  if (validate) layers.push_back(VALIDATION_LAYER);
  if (has_debug_utils(nullptr) || validate) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validate) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  const VkInstanceCreateInfo create{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = validate ? &features : nullptr,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                                    .ppEnabledLayerNames = layers.data(),
                                    .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&create, nullptr, &instance), "creating a Vulkan instance");
  return take(vulkan::load_instance(vkGetInstanceProcAddr, instance, INSTANCE_VERSION), Exit::no_device);
}

bool can_describe_pipelines(VkPhysicalDevice physical) {
  if (!has_extension(physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME)) return false;
  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR has{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR};
  VkPhysicalDeviceFeatures2 features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &has};
  vkGetPhysicalDeviceFeatures2(physical, &features);
  return has.pipelineExecutableInfo == VK_TRUE;
}

/// Extensions and features that are enabled where the device has them.
class OptionalFeatures {
 public:
  OptionalFeatures(const vulkan::Instance& instance, VkPhysicalDevice physical, const ContextInfo& info, void* next)
      : extensions(vulkan::useful_extensions(instance, physical)),
        conservative_raster(has(VK_EXT_CONSERVATIVE_RASTERIZATION_EXTENSION_NAME)),
        describes(info.pipeline_statistics && can_describe_pipelines(physical)),
        unchecked(vulkan::has_pipeline_robustness(instance, physical)),
        chain_(next) {
    if (!info.push_descriptors)
      std::erase_if(extensions, [](std::string_view name) { return name == VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME; });
    if (describes) add(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME, describe_);
    if (unchecked) add(VK_EXT_PIPELINE_ROBUSTNESS_EXTENSION_NAME, robustness_);
  }
  OptionalFeatures(const OptionalFeatures&) = delete;
  OptionalFeatures& operator=(const OptionalFeatures&) = delete;

  [[nodiscard]] const void* chain() const { return chain_; }

  std::vector<const char*> extensions;
  bool conservative_raster;
  bool describes;
  bool unchecked;

 private:
  [[nodiscard]] bool has(std::string_view name) const {
    return std::ranges::find(extensions, name) != extensions.end();
  }
  template <class Features>
  void add(const char* extension, Features& features) {
    extensions.push_back(extension);
    features.pNext = chain_;
    chain_ = &features;
  }

  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR describe_{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
      .pipelineExecutableInfo = VK_TRUE};
  VkPhysicalDevicePipelineRobustnessFeaturesEXT robustness_{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_ROBUSTNESS_FEATURES_EXT, .pipelineRobustness = VK_TRUE};
  void* chain_;
};

std::uint32_t graphics_queue_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags NEEDED = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (std::uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & NEEDED) == NEEDED && families[i].timestampValidBits != 0) return i;
  throw Error("the device has no queue with graphics, compute and timestamps", Exit::no_device);
}

}  // namespace

bool has_extension(VkPhysicalDevice physical, std::string_view name) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::ranges::any_of(extensions, [&](const auto& extension) { return name == extension.extensionName; });
}

struct Context::Messages {
  std::mutex mutex;
  std::vector<std::string> lines;

  static VkBool32 receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& messages = *static_cast<Messages*>(user);
    const std::lock_guard lock(messages.mutex);
    const std::string_view text(data->pMessage);
    const std::string_view id(data->pMessageIdName == nullptr ? "" : data->pMessageIdName);
    // Layers since 1.4 leave the name out of the text.
    messages.lines.push_back(text.find(id) != std::string_view::npos ? std::string(text)
                                                                     : fmt::format("[{}] {}", id, text));
    return VK_FALSE;
  }
};

std::vector<DeviceRow> list_devices() {
  const vulkan::Instance instance = make_instance(ContextInfo::Validation::off);
  std::vector<DeviceRow> rows;
  for (VkPhysicalDevice physical : physical_devices(instance.handle)) rows.push_back(describe(instance, physical));
  vkDestroyInstance(instance.handle, nullptr);
  return rows;
}

Context::Context(const ContextInfo& info) : messages_(std::make_unique<Messages>()) {
  instance_ = make_instance(info.validation, info.instance_extensions);
  if (info.validation == ContextInfo::Validation::on) create_messenger();
  physical_ = choose_device(instance_, info.device);
  row_ = describe(instance_, physical_);
  create_device(info);
}

void Context::create_messenger() {
  const VkDebugUtilsMessengerCreateInfoEXT create{
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
      .pfnUserCallback = &Messages::receive,
      .pUserData = messages_.get()};
  const auto create_function = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_.handle, "vkCreateDebugUtilsMessengerEXT"));
  check(create_function(instance_.handle, &create, nullptr, &messenger_), "creating a debug messenger");
}

void Context::create_device(const ContextInfo& info) {
  queue_family_ = graphics_queue_family(physical_);
  vulkan::RequiredFeatures features;
  VkPhysicalDeviceFeatures has{};
  vkGetPhysicalDeviceFeatures(physical_, &has);
  if (has.depthClamp == VK_FALSE)
    throw Error("device " + row_.name + ": lacks the feature depthClamp", Exit::no_device);
  features.base.features.depthClamp = VK_TRUE;
  features.base.features.samplerAnisotropy = has.samplerAnisotropy;
  features.base.features.shaderFloat64 = has.shaderFloat64;
  // Shadow maps need these; who draws them asks whether they are there.
  features.base.features.shaderStorageImageExtendedFormats = has.shaderStorageImageExtendedFormats;
  features.base.features.shaderClipDistance = has.shaderClipDistance;
  features.base.features.multiDrawIndirect = has.multiDrawIndirect;
  features.base.features.drawIndirectFirstInstance = has.drawIndirectFirstInstance;
  features.base.features.multiViewport = has.multiViewport;
  doubles_ = has.shaderFloat64 == VK_TRUE;
  vulkan::RequiredFeatures all(VK_FALSE);
  vkGetPhysicalDeviceFeatures2(physical_, &all.base);
  features.vulkan12.bufferDeviceAddress = all.vulkan12.bufferDeviceAddress;
  features.vulkan12.shaderOutputViewportIndex = all.vulkan12.shaderOutputViewportIndex;

  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = queue_family_,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  const auto required = vulkan::required_extensions();
  const OptionalFeatures optional(instance_, physical_, info, &features.base);
  std::vector<const char*> extensions(required.begin(), required.end());
  extensions.insert(extensions.end(), optional.extensions.begin(), optional.extensions.end());
  extensions.insert(extensions.end(), info.device_extensions.begin(), info.device_extensions.end());
  const VkDeviceCreateInfo create{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = optional.chain(),
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
  check(vkCreateDevice(physical_, &create, nullptr, &handle_), "creating the device");
  vkGetDeviceQueue(handle_, queue_family_, 0, &queue_);
  device_ = take(vulkan::make_device(instance_, physical_, handle_), Exit::no_device);
  device_.traits.conservative_raster = optional.conservative_raster;
  device_.pipeline_statistics = optional.describes;
  device_.pipeline_robustness = optional.unchecked;
  addresses_ = features.vulkan12.bufferDeviceAddress == VK_TRUE;
  pipelines_ = std::make_unique<vulkan::PipelineStore>();
  device_.pipelines = pipelines_.get();
  sets_ = std::make_unique<vulkan::DescriptorSets>(device_);
  device_.sets = sets_.get();
}

Context::~Context() {
  sets_.reset();
  pipelines_.reset();
  if (handle_ != VK_NULL_HANDLE) {
    vkDestroyFence(handle_, fence_, nullptr);
    vkDestroyCommandPool(handle_, pool_, nullptr);
    vkDestroyDevice(handle_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE)
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
        instance_.handle, "vkDestroyDebugUtilsMessengerEXT"))(instance_.handle, messenger_, nullptr);
  vkDestroyInstance(instance_.handle, nullptr);
}

void Context::create_submission() {
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                     .queueFamilyIndex = queue_family_};
  check(vkCreateCommandPool(handle_, &pool, nullptr, &pool_), "creating a command pool");
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  check(vkCreateFence(handle_, &fence, nullptr, &fence_), "creating a fence");
}

void Context::submit(const std::function<void(VkCommandBuffer)>& record) {
  if (fence_ == VK_NULL_HANDLE) create_submission();
  const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = pool_,
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(handle_, &allocate, &commands), "allocating a command buffer");
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(commands, &begin), "beginning a command buffer");
  sets_->reset();
  record(commands);
  if (const std::optional<lamp::Error>& error = sets_->error()) throw Error(*error, Exit::no_device);
  check(vkEndCommandBuffer(commands), "ending a command buffer");
  const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                         .commandBuffer = commands};
  const VkSubmitInfo2 submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer};
  {
    const std::lock_guard lock(queue_mutex_);
    check(vkQueueSubmit2(queue_, 1, &submit, fence_), "submitting to the device");
  }
  check(vkWaitForFences(handle_, 1, &fence_, VK_TRUE, UINT64_MAX), "waiting for the device");
  check(vkResetFences(handle_, 1, &fence_), "resetting a fence");
  check(vkResetCommandPool(handle_, pool_, 0), "resetting the command pool");
  vkFreeCommandBuffers(handle_, pool_, 1, &commands);
  last_done_ = std::chrono::steady_clock::now();
}

double Context::idle_ms() const {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - last_done_).count();
}

std::vector<std::string> Context::take_messages() {
  const std::lock_guard lock(messages_->mutex);
  return std::exchange(messages_->lines, {});
}

}  // namespace lamp::app
