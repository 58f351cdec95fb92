// A look-up's constants and buffers as Vulkan takes them.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/bound_lookup.h"

#include <cassert>
#include <cstddef>
#include <utility>

#include "null_handles.h"

namespace lamp::vulkan {

VkSpecializationInfo SpecializationConstants::info() const {
  return {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
          .pMapEntries = entries.data(),
          .dataSize = constants.size() * sizeof(Constant),
          .pData = constants.data()};
}

BoundLookUp BoundLookUp::moved_to(std::uint32_t first_binding, std::uint32_t first_constant) const {
  BoundLookUp moved = *this;
  for (Constant& constant : moved.constants) constant.id += first_constant - LOOKUP_CONSTANT;
  for (Bound& bound : moved.resources) bound.binding += first_binding - LOOKUP_BINDING;
  return moved;
}

std::vector<VkDescriptorSetLayoutBinding> BoundLookUp::layout_bindings(
    VkShaderStageFlags stages, std::vector<VkDescriptorSetLayoutBinding> own) const {
  for (const Bound& bound : resources)
    own.push_back(
        {.binding = bound.binding, .descriptorType = bound.resource.type, .descriptorCount = 1, .stageFlags = stages});
  return own;
}

DescriptorWrites BoundLookUp::writes(VkDescriptorSet set) const {
  DescriptorWrites made;
  made.buffers.reserve(resources.size());  // writes point into it
  for (const Bound& bound : resources) {
    const Resource& resource = bound.resource;
    assert(resource.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER && "write look-ups that a shader is fused with yourself");
    made.buffers.push_back({.buffer = resource.buffer, .offset = resource.offset, .range = resource.range});
    made.writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                           .dstSet = set,
                           .dstBinding = bound.binding,
                           .descriptorCount = 1,
                           .descriptorType = resource.type,
                           .pBufferInfo = &made.buffers.back()});
  }
  return made;
}

void BoundLookUp::write_to(const Device& device, VkDescriptorSet set) const {
  const DescriptorWrites made = writes(set);
  device.vk.vkUpdateDescriptorSets(device.handle, static_cast<std::uint32_t>(made.writes.size()), made.writes.data(), 0,
                                   nullptr);
}

SpecializationConstants BoundLookUp::specialization(std::vector<Constant> own) const {
  SpecializationConstants made{.constants = std::move(own)};
  made.constants.insert(made.constants.end(), constants.begin(), constants.end());
  for (std::uint32_t i = 0; i < made.constants.size(); ++i)
    made.entries.push_back({.constantID = made.constants[i].id,
                            .offset = static_cast<std::uint32_t>(i * sizeof(Constant) + offsetof(Constant, value)),
                            .size = sizeof(Constant::value)});
  return made;
}

Result<std::vector<VkDeviceAddress>> BoundLookUp::addresses(const Device& device) const {
  if (!device.buffer_addresses)
    return Error{"look-up " + std::string(name),
                 "expected a device with the feature bufferDeviceAddress that says Device::buffer_addresses, "
                 "got one without"};
  if (auto error = check_made(device)) return *error;
  if (!addressable)
    return Error{"look-up " + std::string(name),
                 "expected buffers made from a device that says Device::buffer_addresses, got some of one without"};
  std::vector<VkDeviceAddress> found;
  for (const Bound& bound : resources) {
    const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                         .buffer = bound.resource.buffer};
    found.push_back(device.vk.vkGetBufferDeviceAddress(device.handle, &info) + bound.resource.offset);
  }
  return found;
}

std::vector<Use> BoundLookUp::buffer_uses(VkPipelineStageFlags2 stages) const {
  std::vector<Use> of_buffers;
  for (const Use& use : uses)
    if (use.resource.buffer != VK_NULL_HANDLE) of_buffers.push_back({use.resource, stages, use.access});
  return of_buffers;
}

}  // namespace lamp::vulkan
