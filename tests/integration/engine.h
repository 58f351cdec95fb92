// A very small renderer: one headless device, one queue, buffers, a depth image, compute pipelines. Plain Vulkan.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lamplight/vulkan.h>
#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

struct MappedBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  std::span<std::byte> bytes;  ///< coherent

  template <class T>
  [[nodiscard]] std::span<T> as() const {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

struct DepthImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

struct ComputePipelineInfo {
  std::span<const std::uint32_t> spirv;
  std::uint32_t set = 0;  ///< that all bindings are in
  std::vector<std::pair<std::uint32_t, VkDescriptorType>> bindings;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> constants;  ///< specialization: id, value
};

struct ComputePipeline {
  std::uint32_t set = 0;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// A buffer, or an image view that a shader samples.
struct Descriptor {
  std::uint32_t binding = 0;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

/// Owns the device and all that was made with it. Throws std::runtime_error.
class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  static constexpr std::uint32_t API_VERSION = VK_API_VERSION_1_3;  ///< of the instance

  [[nodiscard]] const lamp::vulkan::Instance& instance() const { return loaded_; }
  [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }
  [[nodiscard]] VkDevice device() const { return device_; }
  [[nodiscard]] std::string device_name() const;

  [[nodiscard]] MappedBuffer make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage);
  [[nodiscard]] DepthImage make_depth_image(VkExtent2D size);
  [[nodiscard]] ComputePipeline make_compute_pipeline(const ComputePipelineInfo& info);

  /// Copies depth values, row by row, and leaves the image ready for compute shaders, SHADER_READ_ONLY_OPTIMAL.
  void record_depth(VkCommandBuffer commands, const DepthImage& depth, VkExtent2D size, VkBuffer values) const;
  void bind(VkCommandBuffer commands, const ComputePipeline& pipeline, std::span<const Descriptor> descriptors) const;

  /// Records, submits and waits.
  void submit(const std::function<void(VkCommandBuffer)>& record);

  /// Messages of the validation layer, if it is installed.
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  void create_instance();
  void create_device();
  [[nodiscard]] VkDescriptorSetLayout make_set_layout(const std::vector<VkDescriptorSetLayoutBinding>& bindings,
                                                      VkDescriptorSetLayoutCreateFlags flags);
  [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties);

  std::vector<std::string> messages_;
  VkInstance instance_ = VK_NULL_HANDLE;
  lamp::vulkan::Instance loaded_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  PFN_vkCmdPushDescriptorSetKHR push_descriptor_set_ = nullptr;
  std::vector<std::function<void()>> destroy_;  ///< last made, first destroyed
};

/// Throws std::runtime_error for anything but VK_SUCCESS.
void check(VkResult result, const char* what);
