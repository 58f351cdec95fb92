// A Vulkan handle that is destroyed with its owner. Move-only.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <utility>

namespace lamp::vulkan {

/// `destroy`: the Vulkan function that does.
template <class Handle>
class Owned {
 public:
  using Destroy = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);
  Owned() = default;
  Owned(VkDevice device, Handle handle, Destroy destroy) : device_(device), handle_(handle), destroy_(destroy) {}
  Owned(Owned&& other) noexcept { swap(other); }
  Owned& operator=(Owned&& other) noexcept {
    swap(other);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (handle_ != VK_NULL_HANDLE) destroy_(device_, handle_, nullptr);
  }
  [[nodiscard]] Handle get() const { return handle_; }

 private:
  void swap(Owned& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    std::swap(destroy_, other.destroy_);
  }
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
  Destroy destroy_ = nullptr;
};

using OwnedBuffer = Owned<VkBuffer>;
using OwnedMemory = Owned<VkDeviceMemory>;
using OwnedImage = Owned<VkImage>;
using OwnedImageView = Owned<VkImageView>;
using OwnedSampler = Owned<VkSampler>;
using OwnedPipeline = Owned<VkPipeline>;
using OwnedPipelineLayout = Owned<VkPipelineLayout>;
using OwnedDescriptorPool = Owned<VkDescriptorPool>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout>;
using OwnedShaderModule = Owned<VkShaderModule>;
using OwnedQueryPool = Owned<VkQueryPool>;
using OwnedCommandPool = Owned<VkCommandPool>;
using OwnedFence = Owned<VkFence>;

}  // namespace lamp::vulkan
