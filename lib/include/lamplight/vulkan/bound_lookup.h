// How a host's shader reads a result: the look-up's file, its constants and buffers, and each as Vulkan takes it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/plan.h"
#include "lamplight/vulkan/device.h"
#include "lamplight/vulkan/pipeline.h"
#include "lamplight/vulkan/recorder.h"

namespace lamp::vulkan {

/// Specialization constants of 32 bits.
struct LAMPLIGHT_API SpecializationConstants {
  std::vector<Constant> constants;
  std::vector<VkSpecializationMapEntry> entries;

  /// For VkPipelineShaderStageCreateInfo. Points into this, which has to be there until the pipeline is made.
  [[nodiscard]] VkSpecializationInfo info() const;
};

/// Writes of storage buffers, for vkUpdateDescriptorSets or vkCmdPushDescriptorSetKHR.
struct DescriptorWrites {
  std::vector<VkDescriptorBufferInfo> buffers;
  std::vector<VkWriteDescriptorSet> writes;  ///< point to these

  DescriptorWrites() = default;
  DescriptorWrites(DescriptorWrites&&) = default;
  DescriptorWrites& operator=(DescriptorWrites&&) = default;
  DescriptorWrites(const DescriptorWrites&) = delete;
  DescriptorWrites& operator=(const DescriptorWrites&) = delete;
};

/// A look-up's resources at their bindings and how a compute shader uses each, and its constants with their ids.
struct LAMPLIGHT_API BoundLookUp {
  std::string_view name;
  std::vector<Constant> constants;
  std::vector<Bound> resources;
  std::vector<Use> uses;
  bool addressable = false;  ///< its buffers were made from a Device that said buffer_addresses

  /// The same for a shader that says LOOKUP_FIRST_BINDING and LOOKUP_FIRST_CONSTANT. Of a look-up as Culler::lookup or
  /// PlanRunner gives it, not of one that was moved before.
  [[nodiscard]] BoundLookUp moved_to(std::uint32_t first_binding, std::uint32_t first_constant = LOOKUP_CONSTANT) const;
  /// Its bindings, for VkDescriptorSetLayoutCreateInfo, behind those of your own.
  [[nodiscard]] std::vector<VkDescriptorSetLayoutBinding> layout_bindings(
      VkShaderStageFlags stages, std::vector<VkDescriptorSetLayoutBinding> own = {}) const;
  /// Of its buffers into a set, or pushed: none.
  [[nodiscard]] DescriptorWrites writes(VkDescriptorSet set = VK_NULL_HANDLE) const;
  /// Writes them into a set that no frame under way uses: at the start, and after the Culler grew.
  void write_to(const Device& device, VkDescriptorSet set) const;
  /// Its constants behind those of your own.
  [[nodiscard]] SpecializationConstants specialization(std::vector<Constant> own = {}) const;
  /// Of its buffers, in the order of their bindings: what a shader with LOOKUP_ADDRESSES reads instead of descriptors.
  /// Errors: a device that does not say Device::buffer_addresses, or did not when the buffers were made.
  [[nodiscard]] Result<std::vector<VkDeviceAddress>> addresses(const Device& device) const;
  /// Those of buffers, by shaders of these stages.
  [[nodiscard]] std::vector<Use> buffer_uses(VkPipelineStageFlags2 stages) const;
};

}  // namespace lamp::vulkan
