// What every example needs of Vulkan: a headless device, buffers, images, pipelines, submission. Nothing of Lamplight.
// Simple, not fast: memory object by object, all buffers mapped, barriers that wait for everything.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "vulkan_functions.h"

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  std::span<std::byte> bytes;  ///< mapped, coherent
  template <class T>
  [[nodiscard]] std::span<T> as() const {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

struct ImageInfo {
  VkExtent2D size{};
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  std::uint32_t layers = 1;
};
struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;     ///< of more than one layer: an array
  std::vector<VkImageView> layer_views;  ///< of each layer
  VkImageAspectFlags aspect = 0;
  VkExtent2D size{};
};

struct Descriptor {
  std::uint32_t binding = 0;         ///< in set 0
  VkBuffer buffer = VK_NULL_HANDLE;  ///< a storage buffer, or
  std::vector<VkImageView> views;    ///< an array of sampled images
};
struct Shader {
  VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
  std::span<const std::uint32_t> spirv;
};
/// One compute shader, or shaders that draw. All of them have 128 bytes of push constants.
struct PipelineInfo {
  std::vector<Shader> shaders;
  std::vector<Descriptor> descriptors;
  std::vector<VkDescriptorSetLayoutBinding> bindings;  ///< more of them, with descriptors
  std::vector<VkWriteDescriptorSet> writes;            ///< of these, into any set
  VkSpecializationInfo constants{};
  std::vector<VkFormat> colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkCompareOp depth_compare = VK_COMPARE_OP_GREATER;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  std::uint32_t view_mask = 0;
};
struct Pipeline {
  VkPipelineBindPoint point = VK_PIPELINE_BIND_POINT_COMPUTE;
  VkPipeline handle = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
};

/// What is drawn to, in the layout ATTACHMENT_OPTIMAL. Colours are cleared to 0.
struct Targets {
  std::vector<Image> colors;
  VkImageView resolve = VK_NULL_HANDLE;  ///< of the one colour
  Image depth;
  VkAttachmentLoadOp depth_load = VK_ATTACHMENT_LOAD_OP_CLEAR;
  float clear_depth = 0.0F;
  std::uint32_t view_mask = 0;
};

struct Queue {
  VkQueue handle = VK_NULL_HANDLE;
  std::uint32_t family = 0;
  VkCommandPool pool = VK_NULL_HANDLE;
};

struct LacksFeature : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Owns the device and all that was made with it. Throws std::runtime_error.
class Gpu {
 public:
  /// Finds the first device. `validate`: with the validation layer, which must be installed.
  explicit Gpu(bool validate);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  void make_device(const VkPhysicalDeviceFeatures2& features, std::span<const char* const> extensions = {});
  [[nodiscard]] Buffer make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  [[nodiscard]] Image make_image(const ImageInfo& info);
  [[nodiscard]] Pipeline make_pipeline(const PipelineInfo& info);
  [[nodiscard]] VkSemaphore make_semaphore();

  /// Records and submits. What it wrote is visible to the host after `wait`, which waits for everything.
  void submit(const Queue& queue, const std::function<void(VkCommandBuffer)>& record,
              VkSemaphore wait_for = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
  void wait();

  VkInstance instance = VK_NULL_HANDLE;  ///< of Vulkan 1.3
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  Queue graphics;
  Queue compute;  ///< of a family without graphics; if there is none, the same as `graphics`

  /// Prints what the validation layer has said; true if that is nothing.
  [[nodiscard]] bool quiet() const;

 private:
  [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties);
  [[nodiscard]] VkPipelineLayout make_layout(const PipelineInfo& info, VkDescriptorSet& set);
  [[nodiscard]] VkPipeline make_drawing(const PipelineInfo& info,
                                        std::span<const VkPipelineShaderStageCreateInfo> stages,
                                        VkPipelineLayout layout) const;

  std::vector<std::string> messages_;  ///< of the validation layer
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::vector<std::function<void()>> destroy_;  ///< last made, first destroyed
};

/// Throws for anything but VK_SUCCESS.
void check(VkResult result, const char* what);
/// Waits for everything before, and makes it visible to everything after.
void barrier(VkCommandBuffer commands);
void transition(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to);
/// From the layout ATTACHMENT_OPTIMAL.
void read_back(VkCommandBuffer commands, const Image& image, const Buffer& to);
void begin_rendering(VkCommandBuffer commands, const Targets& targets);
void bind(VkCommandBuffer commands, const Pipeline& pipeline, std::span<const std::byte> push_constants);
template <class T>
void bind(VkCommandBuffer commands, const Pipeline& pipeline, const T& push_constants) {
  bind(commands, pipeline, std::as_bytes(std::span(&push_constants, 1)));
}
