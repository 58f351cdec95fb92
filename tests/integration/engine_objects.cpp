// Buffers, the depth image, compute pipelines and their descriptors.
// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "engine.h"

VkDeviceMemory Engine::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
  std::uint32_t type = 0;
  while (type < memory.memoryTypeCount && ((needs.memoryTypeBits >> type & 1U) == 0 ||
                                           (memory.memoryTypes[type].propertyFlags & properties) != properties))
    ++type;
  if (type == memory.memoryTypeCount) throw std::runtime_error("the device has no such memory");
  const VkMemoryAllocateInfo info{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  check(vkAllocateMemory(device_, &info, nullptr, &allocated), "allocating memory");
  destroy_.emplace_back([=, this] { vkFreeMemory(device_, allocated, nullptr); });
  return allocated;
}

MappedBuffer Engine::make_buffer(VkDeviceSize bytes, VkBufferUsageFlags usage) {
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(device_, &info, nullptr, &buffer), "creating a buffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device_, buffer, &needs);
  const VkDeviceMemory memory =
      allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  destroy_.emplace_back([=, this] { vkDestroyBuffer(device_, buffer, nullptr); });
  check(vkBindBufferMemory(device_, buffer, memory, 0), "binding a buffer");
  void* mapped = nullptr;
  check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping a buffer");
  return {buffer, {static_cast<std::byte*>(mapped), bytes}};
}

DepthImage Engine::make_depth_image(VkExtent2D size) {
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = VK_FORMAT_D32_SFLOAT,
                               .extent = {size.width, size.height, 1},
                               .mipLevels = 1,
                               .arrayLayers = 1,
                               .samples = VK_SAMPLE_COUNT_1_BIT,
                               .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
  DepthImage depth;
  check(vkCreateImage(device_, &info, nullptr, &depth.image), "creating a depth image");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device_, depth.image, &needs);
  const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  destroy_.emplace_back([this, image = depth.image] { vkDestroyImage(device_, image, nullptr); });
  check(vkBindImageMemory(device_, depth.image, memory, 0), "binding a depth image");
  const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = depth.image,
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = VK_FORMAT_D32_SFLOAT,
                                   .subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
  check(vkCreateImageView(device_, &view, nullptr, &depth.view), "creating a view of depth");
  destroy_.emplace_back([this, made = depth.view] { vkDestroyImageView(device_, made, nullptr); });
  return depth;
}

VkDescriptorSetLayout Engine::make_set_layout(const std::vector<VkDescriptorSetLayoutBinding>& bindings,
                                              VkDescriptorSetLayoutCreateFlags flags) {
  const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                             .flags = flags,
                                             .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                             .pBindings = bindings.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device_, &info, nullptr, &layout), "creating a set layout");
  destroy_.emplace_back([=, this] { vkDestroyDescriptorSetLayout(device_, layout, nullptr); });
  return layout;
}

ComputePipeline Engine::make_compute_pipeline(const ComputePipelineInfo& info) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const auto& [binding, type] : info.bindings)
    bindings.push_back(
        {.binding = binding, .descriptorType = type, .descriptorCount = 1, .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT});
  ComputePipeline made{.set = info.set};
  std::vector<VkDescriptorSetLayout> sets;
  while (sets.size() < info.set) sets.push_back(make_set_layout({}, 0));
  sets.push_back(make_set_layout(bindings, VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR));
  const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = static_cast<std::uint32_t>(sets.size()),
                                          .pSetLayouts = sets.data()};
  check(vkCreatePipelineLayout(device_, &layout, nullptr, &made.layout), "creating a pipeline layout");
  destroy_.emplace_back([=, this] { vkDestroyPipelineLayout(device_, made.layout, nullptr); });

  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  for (const auto& [id, value] : info.constants) {
    entries.push_back(
        {.constantID = id, .offset = static_cast<std::uint32_t>(values.size() * sizeof(value)), .size = sizeof(value)});
    values.push_back(value);
  }
  const VkSpecializationInfo constants{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                       .pMapEntries = entries.data(),
                                       .dataSize = values.size() * sizeof(std::uint32_t),
                                       .pData = values.data()};
  const VkShaderModuleCreateInfo module_info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                             .codeSize = info.spirv.size_bytes(),
                                             .pCode = info.spirv.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device_, &module_info, nullptr, &module), "creating a shader module");
  const VkComputePipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                     .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                     .module = module,
                                                     .pName = "main",
                                                     .pSpecializationInfo = &constants},
                                           .layout = made.layout};
  const VkResult result = vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &create, nullptr, &made.pipeline);
  vkDestroyShaderModule(device_, module, nullptr);
  check(result, "creating a pipeline");
  destroy_.emplace_back([=, this] { vkDestroyPipeline(device_, made.pipeline, nullptr); });
  return made;
}

void Engine::bind(VkCommandBuffer commands, const ComputePipeline& pipeline,
                  std::span<const Descriptor> descriptors) const {
  std::vector<VkDescriptorBufferInfo> buffers(descriptors.size());
  std::vector<VkDescriptorImageInfo> images(descriptors.size());
  std::vector<VkWriteDescriptorSet> writes;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const auto& [binding, buffer, view] = descriptors[i];
    buffers[i] = {.buffer = buffer, .range = VK_WHOLE_SIZE};
    images[i] = {.imageView = view, .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstBinding = binding,
                      .descriptorCount = 1,
                      .descriptorType = buffer == VK_NULL_HANDLE ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE
                                                                 : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                      .pImageInfo = &images[i],
                      .pBufferInfo = &buffers[i]});
  }
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  push_descriptor_set_(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, pipeline.set,
                       static_cast<std::uint32_t>(writes.size()), writes.data());
}

void Engine::record_depth(VkCommandBuffer commands, const DepthImage& depth, VkExtent2D size, VkBuffer values) const {
  VkImageMemoryBarrier2 image{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                              .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,  // the last frame's readers
                              .dstStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                              .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                              .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
                              .newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                              .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                              .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                              .image = depth.image,
                              .subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &image};
  vkCmdPipelineBarrier2(commands, &dependency);
  const VkBufferImageCopy all{.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                              .imageExtent = {size.width, size.height, 1}};
  vkCmdCopyBufferToImage(commands, values, depth.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &all);
  image.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  image.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  image.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  image.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  image.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  image.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  vkCmdPipelineBarrier2(commands, &dependency);
}
