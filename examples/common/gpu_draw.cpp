// Pipelines, barriers, render passes.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstring>

#include "gpu.h"

VkPipelineLayout Gpu::make_layout(const PipelineInfo& info, VkDescriptorSet& set) {
  const std::vector<Descriptor>& descriptors = info.descriptors;
  std::vector<VkDescriptorSetLayoutBinding> bindings = info.bindings;
  std::vector<VkDescriptorBufferInfo> buffers(descriptors.size());
  std::vector<std::vector<VkDescriptorImageInfo>> images(descriptors.size());
  std::vector<VkWriteDescriptorSet> writes = info.writes;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const Descriptor& d = descriptors[i];
    buffers[i] = {.buffer = d.buffer, .range = VK_WHOLE_SIZE};
    for (const VkImageView view : d.views)
      images[i].push_back({.imageView = view, .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
    const VkDescriptorType type =
        d.views.empty() ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    const std::uint32_t count = d.views.empty() ? 1 : static_cast<std::uint32_t>(d.views.size());
    bindings.push_back({d.binding, type, count, VK_SHADER_STAGE_ALL, nullptr});
    writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstBinding = d.binding,
                      .descriptorCount = count,
                      .descriptorType = type,
                      .pImageInfo = images[i].data(),
                      .pBufferInfo = &buffers[i]});
  }
  const VkDescriptorSetLayoutCreateInfo set_info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                 .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                 .pBindings = bindings.data()};
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device, &set_info, nullptr, &set_layout), "creating a set layout");
  destroy_.emplace_back([=, this] { vkDestroyDescriptorSetLayout(device, set_layout, nullptr); });
  constexpr std::array SIZES{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 16},
                             VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 64}};
  const VkDescriptorPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = SIZES.size(),
                                             .pPoolSizes = SIZES.data()};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "creating a descriptor pool");
  destroy_.emplace_back([=, this] { vkDestroyDescriptorPool(device, pool, nullptr); });
  const VkDescriptorSetAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pool,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &set_layout};
  check(vkAllocateDescriptorSets(device, &allocate, &set), "allocating a set");
  for (VkWriteDescriptorSet& write : writes) write.dstSet = set;
  vkUpdateDescriptorSets(device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
  constexpr VkPushConstantRange PUSHED{VK_SHADER_STAGE_ALL, 0, 128};
  const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 1,
                                               .pSetLayouts = &set_layout,
                                               .pushConstantRangeCount = 1,
                                               .pPushConstantRanges = &PUSHED};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout), "creating a pipeline layout");
  destroy_.emplace_back([=, this] { vkDestroyPipelineLayout(device, layout, nullptr); });
  return layout;
}

Pipeline Gpu::make_pipeline(const PipelineInfo& info) {
  Pipeline made;
  made.layout = make_layout(info, made.set);
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  for (const Shader& shader : info.shaders) {
    const VkShaderModuleCreateInfo module{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                          .codeSize = shader.spirv.size_bytes(),
                                          .pCode = shader.spirv.data()};
    stages.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                      .stage = shader.stage,
                      .pName = "main",
                      .pSpecializationInfo = &info.constants});
    check(vkCreateShaderModule(device, &module, nullptr, &stages.back().module), "creating a shader module");
    destroy_.emplace_back([this, m = stages.back().module] { vkDestroyShaderModule(device, m, nullptr); });
  }
  if (stages.front().stage == VK_SHADER_STAGE_COMPUTE_BIT) {
    const VkComputePipelineCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, .stage = stages.front(), .layout = made.layout};
    check(vkCreateComputePipelines(device, nullptr, 1, &create, nullptr, &made.handle), "creating a pipeline");
  } else {
    made.point = VK_PIPELINE_BIND_POINT_GRAPHICS;
    made.handle = make_drawing(info, stages, made.layout);
  }
  destroy_.emplace_back([this, handle = made.handle] { vkDestroyPipeline(device, handle, nullptr); });
  return made;
}

VkPipeline Gpu::make_drawing(const PipelineInfo& info, std::span<const VkPipelineShaderStageCreateInfo> stages,
                             VkPipelineLayout layout) const {
  const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                .viewMask = info.view_mask,
                                                .colorAttachmentCount = static_cast<std::uint32_t>(info.colors.size()),
                                                .pColorAttachmentFormats = info.colors.data(),
                                                .depthAttachmentFormat = info.depth};
  const VkPipelineVertexInputStateCreateInfo input{.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  const VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0F};
  const VkPipelineMultisampleStateCreateInfo samples{.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                     .rasterizationSamples = info.samples};
  const VkPipelineDepthStencilStateCreateInfo depth{.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                                                    .depthTestEnable = VK_TRUE,
                                                    .depthWriteEnable = info.depth_compare != VK_COMPARE_OP_EQUAL,
                                                    .depthCompareOp = info.depth_compare};
  const std::vector<VkPipelineColorBlendAttachmentState> colors(info.colors.size(), {.colorWriteMask = 0xF});
  const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                  .attachmentCount = static_cast<std::uint32_t>(colors.size()),
                                                  .pAttachments = colors.data()};
  constexpr std::array DYNAMIC{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  const VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                 .dynamicStateCount = DYNAMIC.size(),
                                                 .pDynamicStates = DYNAMIC.data()};
  const VkGraphicsPipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = static_cast<std::uint32_t>(stages.size()),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout};
  VkPipeline made = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device, nullptr, 1, &create, nullptr, &made), "creating a pipeline");
  return made;
}

namespace {

constexpr VkMemoryBarrier2 EVERYTHING{
    .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
    .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
    .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
    .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};

VkRenderingAttachmentInfo attachment(VkImageView view, VkAttachmentLoadOp load, VkClearValue clear = {}) {
  return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
          .imageView = view,
          .imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL,
          .loadOp = load,
          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
          .clearValue = clear};
}

}  // namespace

void barrier(VkCommandBuffer commands) {
  const VkDependencyInfo info{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &EVERYTHING};
  vkCmdPipelineBarrier2(commands, &info);
}

void transition(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to) {
  const VkImageMemoryBarrier2 change{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = EVERYTHING.srcStageMask,
      .srcAccessMask = EVERYTHING.srcAccessMask,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .dstAccessMask = EVERYTHING.dstAccessMask,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image.handle,
      .subresourceRange = {image.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
  const VkDependencyInfo info{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &change};
  vkCmdPipelineBarrier2(commands, &info);
}

void read_back(VkCommandBuffer commands, const Image& image, const Buffer& to) {
  transition(commands, image, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  const VkBufferImageCopy all{.imageSubresource = {image.aspect, 0, 0, 1},
                              .imageExtent = {image.size.width, image.size.height, 1}};
  vkCmdCopyImageToBuffer(commands, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle, 1, &all);
}

void begin_rendering(VkCommandBuffer commands, const Targets& targets) {
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const Image& image : targets.colors) colors.push_back(attachment(image.view, VK_ATTACHMENT_LOAD_OP_CLEAR));
  if (targets.resolve != VK_NULL_HANDLE) {
    colors.front().resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    colors.front().resolveImageView = targets.resolve;
    colors.front().resolveImageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
  }
  const VkClearValue clear_depth{.depthStencil = {.depth = targets.clear_depth}};
  const VkRenderingAttachmentInfo depth = attachment(targets.depth.view, targets.depth_load, clear_depth);
  const VkExtent2D size = targets.depth.size;
  const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = {.extent = size},
                             .layerCount = 1,
                             .viewMask = targets.view_mask,
                             .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1};
  const VkRect2D scissor{.extent = size};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

void bind(VkCommandBuffer commands, const Pipeline& pipeline, std::span<const std::byte> push_constants) {
  vkCmdBindPipeline(commands, pipeline.point, pipeline.handle);
  vkCmdBindDescriptorSets(commands, pipeline.point, pipeline.layout, 0, 1, &pipeline.set, 0, nullptr);
  vkCmdPushConstants(commands, pipeline.layout, VK_SHADER_STAGE_ALL, 0,
                     static_cast<std::uint32_t>(push_constants.size()), push_constants.data());
}
