// What every example needs of Vulkan: a headless device, buffers, images, pipelines, submission. Nothing of Lamplight.
// Simple, not fast: memory object by object, all buffers mapped, barriers that wait for everything. Errors are thrown.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

struct Buffer {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Buffer owner = nullptr;
  VkBuffer handle = VK_NULL_HANDLE;
  std::span<std::byte> bytes;  ///< mapped, coherent
  template <class T>
  [[nodiscard]] std::span<T> as() const {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

/// Always in the layout eGeneral.
struct Image {
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::Image handle = nullptr;
  vk::raii::ImageView view = nullptr;  ///< of more than one layer: an array
  vk::Extent2D size;
};

constexpr vk::Format COLOR = vk::Format::eR32G32B32A32Sfloat;
constexpr vk::Format DEPTH = vk::Format::eD32Sfloat;

/// A compute shader, or those that draw; without a fragment shader depth alone. 128 bytes of push constants.
struct PipelineInfo {
  std::span<const std::uint32_t> compute, vertex, fragment;  ///< SPIR-V
  std::vector<vk::DescriptorImageInfo> images;               ///< sampled, an array at binding 0 of set 0
  std::vector<vk::DescriptorBufferInfo> buffers;             ///< of storage, at bindings 1, 2 and so on
  std::vector<VkDescriptorSetLayoutBinding> bindings;        ///< more, which the example writes itself
  vk::SpecializationInfo constants;
  vk::CompareOp depth_compare = vk::CompareOp::eGreater;
  bool blended = false;  ///< over what is there: colour is premultiplied; depth stays, and what is there in w
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  std::uint32_t view_mask = 0;
  bool depth_alone = false;  ///< draws to no colour; depth beyond 0 .. 1 is clamped
};
struct Pipeline {
  vk::PipelineBindPoint point;
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::DescriptorSet set = nullptr;
  vk::raii::PipelineLayout layout = nullptr;
  vk::raii::Pipeline handle = nullptr;
};

/// What is drawn to. Colour is cleared to 0.
struct Targets {
  const Image* color = nullptr;  ///< none: depth alone
  const Image& depth;
  std::optional<float> clear_depth;  ///< none: it stays as it is
  std::uint32_t view_mask = 0;
};

using Commands = vk::raii::CommandBuffer;

/// The first device. Has to outlive all that was made with it.
class Gpu {
 public:
  void make_device(const VkPhysicalDeviceFeatures2& features, const std::vector<const char*>& extensions = {});
  [[nodiscard]] Buffer make_buffer(vk::DeviceSize bytes) const;
  [[nodiscard]] Image make_image(vk::Format format, vk::Extent2D size,
                                 vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1,
                                 std::uint32_t layers = 1);
  [[nodiscard]] Pipeline make_pipeline(const PipelineInfo& info) const;

  /// Records and submits, with the semaphores of `info`. After `wait` all is done, and visible to the host.
  void submit(std::uint32_t family, const std::function<void(const Commands&)>& record, vk::SubmitInfo info = {});
  void wait() {
    device.waitIdle();
    submitted_.clear();
  }

  vk::raii::Context context;  ///< loads Vulkan's functions: no example links a loader
  vk::ApplicationInfo application{.apiVersion = VK_API_VERSION_1_3};
  vk::raii::Instance instance{context, vk::InstanceCreateInfo{.pApplicationInfo = &application}};
  vk::raii::PhysicalDevice physical = std::move(vk::raii::PhysicalDevices(instance).at(0));
  vk::raii::Device device = nullptr;
  std::uint32_t graphics = 0;  ///< a queue family that computes, too

 private:
  vk::raii::DescriptorPool descriptors_ = nullptr;
  std::vector<std::pair<vk::raii::CommandPool, vk::raii::CommandBuffers>> submitted_;  ///< since `wait`
};

/// Waits for everything before, and makes it visible to everything after. So do the next two, first.
void barrier(const Commands& commands);
void read_back(const Commands& commands, const Image& image, const Buffer& to);
void begin_rendering(const Commands& commands, const Targets& targets);
template <class T>
void bind(const Commands& commands, const Pipeline& pipeline, const T& push_constants) {
  commands.bindPipeline(pipeline.point, *pipeline.handle);
  commands.bindDescriptorSets(pipeline.point, *pipeline.layout, 0, *pipeline.set, {});
  commands.pushConstants<T>(*pipeline.layout, vk::ShaderStageFlagBits::eAll, 0, push_constants);
}
