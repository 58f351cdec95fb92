// Takes sets from pools; makes another pool when the last is full.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/descriptor_sets.h"

#include <algorithm>

namespace lamp::vulkan {
namespace {

constexpr std::uint32_t SETS_PER_POOL = 64;

/// Room for sets as Lamplight's passes have them: up to eight buffers and a depth image in a method, five textures of a
/// material in the tool; and for SETS_PER_POOL of any set that has more.
std::vector<VkDescriptorPoolSize> pool_sizes(std::span<const DescriptorBinding> bindings) {
  std::vector<VkDescriptorPoolSize> sizes{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 5},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 4},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}};
  for (const DescriptorBinding& binding : bindings) {
    const auto needed =
        static_cast<std::uint32_t>(std::ranges::count(bindings, binding.type, &DescriptorBinding::type));
    const auto size = std::ranges::find(sizes, binding.type, &VkDescriptorPoolSize::type);
    if (size == sizes.end())
      sizes.push_back({binding.type, needed});
    else
      size->descriptorCount = std::max(size->descriptorCount, needed);
  }
  for (VkDescriptorPoolSize& size : sizes) size.descriptorCount *= SETS_PER_POOL;
  return sizes;
}

bool is_full(VkResult result) { return result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL; }

}  // namespace

std::optional<Error> DescriptorSets::add_pool(const Pipeline& pipeline) {
  const std::vector<VkDescriptorPoolSize> sizes = pool_sizes(pipeline.bindings());
  const VkDescriptorPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = SETS_PER_POOL,
                                          .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                          .pPoolSizes = sizes.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  if (const VkResult r = vk_.vkCreateDescriptorPool(device_, &create, nullptr, &pool); r != VK_SUCCESS)
    return Error{"descriptor pool for " + pipeline.name(), result_text(r)};
  pools_.emplace_back(device_, pool, vk_.vkDestroyDescriptorPool);
  return std::nullopt;
}

Result<VkDescriptorSet> DescriptorSets::allocate(const Pipeline& pipeline) {
  if (device_ == VK_NULL_HANDLE || vk_.vkCreateDescriptorPool == nullptr) {
    if (!error_) error_ = Error{"descriptor sets", "expected a device that make_device gave, got null"};
    return *error_;
  }
  const VkDescriptorSetLayout layout = pipeline.set_layout();
  for (;; ++current_) {
    const bool is_new = current_ == pools_.size();
    std::optional<Error> error = is_new ? add_pool(pipeline) : std::nullopt;
    if (!error) {
      const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pools_[current_].get(),
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &layout};
      VkDescriptorSet set = VK_NULL_HANDLE;
      const VkResult r = vk_.vkAllocateDescriptorSets(device_, &info, &set);
      if (r == VK_SUCCESS) return set;
      if (is_full(r) && !is_new) continue;
      error = Error{"descriptor set of " + pipeline.name(), result_text(r)};
    }
    if (!error_) error_ = error;
    return *error;
  }
}

void DescriptorSets::reset() {
  for (const OwnedDescriptorPool& pool : pools_) vk_.vkResetDescriptorPool(device_, pool.get(), 0);
  current_ = 0;
  error_.reset();
}

}  // namespace lamp::vulkan
