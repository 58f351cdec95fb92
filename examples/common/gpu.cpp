// The device, its memory, submission, pipelines, drawing.
// SPDX-License-Identifier: Apache-2.0
#include "gpu.h"

#include <array>

namespace {

constexpr auto ALL = vk::PipelineStageFlagBits::eAllCommands;
constexpr auto LAYOUT = vk::ImageLayout::eGeneral;  // of all images

/// For a buffer or an image. Vulkan promises memory with each of the properties that are asked for below.
template <class T>
vk::raii::DeviceMemory allocate(const Gpu& gpu, const T& object, vk::MemoryPropertyFlags properties) {
  const vk::MemoryRequirements needs = object.getMemoryRequirements();
  const vk::PhysicalDeviceMemoryProperties memory = gpu.physical.getMemoryProperties();
  std::uint32_t type = 0;
  while ((needs.memoryTypeBits >> type & 1U) == 0 || properties & ~memory.memoryTypes.at(type).propertyFlags) ++type;
  vk::raii::DeviceMemory made(gpu.device, {.allocationSize = needs.size, .memoryTypeIndex = type});
  object.bindMemory(*made, 0);
  return made;
}

vk::raii::Pipeline make_drawing(const vk::raii::Device& device, const PipelineInfo& info, vk::PipelineLayout layout,
                                const std::vector<vk::PipelineShaderStageCreateInfo>& stages) {
  vk::PipelineRenderingCreateInfo rendering{.viewMask = info.view_mask, .depthAttachmentFormat = DEPTH};
  if (!info.depth_alone) rendering.setColorAttachmentFormats(COLOR);
  const vk::PipelineVertexInputStateCreateInfo input;
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.depthClampEnable = info.depth_alone, .lineWidth = 1.0F};
  const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples = info.samples};
  const vk::PipelineDepthStencilStateCreateInfo depth{
      .depthTestEnable = VK_TRUE, .depthWriteEnable = !info.blended, .depthCompareOp = info.depth_compare};
  const vk::PipelineColorBlendAttachmentState color{
      .blendEnable = info.blended,
      .srcColorBlendFactor = vk::BlendFactor::eOne,
      .dstColorBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
      .dstAlphaBlendFactor = vk::BlendFactor::eOne,
      .colorWriteMask = vk::ColorComponentFlags(info.fragment.empty() ? 0 : 0xF)};
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = rendering.colorAttachmentCount,
                                                    .pAttachments = &color};
  constexpr std::array DYNAMIC{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const auto dynamic = vk::PipelineDynamicStateCreateInfo{}.setDynamicStates(DYNAMIC);
  vk::GraphicsPipelineCreateInfo create{.pNext = &rendering,
                                        .pVertexInputState = &input,
                                        .pInputAssemblyState = &assembly,
                                        .pViewportState = &viewport,
                                        .pRasterizationState = &raster,
                                        .pMultisampleState = &samples,
                                        .pDepthStencilState = &depth,
                                        .pColorBlendState = &blend,
                                        .pDynamicState = &dynamic,
                                        .layout = layout};
  return {device, nullptr, create.setStages(stages)};
}

}  // namespace

void Gpu::make_device(const VkPhysicalDeviceFeatures2& features, const std::vector<const char*>& extensions) {
  constexpr float PRIORITY = 1.0F;
  constexpr vk::QueueFlags DRAWS_AND_COMPUTES = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
  std::vector<vk::DeviceQueueCreateInfo> queues;  // of each family one
  for (const vk::QueueFamilyProperties& family : physical.getQueueFamilyProperties()) {
    const auto index = static_cast<std::uint32_t>(queues.size());
    queues.push_back(vk::DeviceQueueCreateInfo{.queueFamilyIndex = index}.setQueuePriorities(PRIORITY));
    if ((family.queueFlags & DRAWS_AND_COMPUTES) == DRAWS_AND_COMPUTES) graphics = index;
  }
  auto info = vk::DeviceCreateInfo{.pNext = &features}.setQueueCreateInfos(queues);
  device = {physical, info.setPEnabledExtensionNames(extensions)};

  constexpr std::array ROOM{vk::DescriptorPoolSize{vk::DescriptorType::eStorageBuffer, 64},
                            vk::DescriptorPoolSize{vk::DescriptorType::eSampledImage, 64}};
  const vk::DescriptorPoolCreateFlags flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet;
  descriptors_ = {device, vk::DescriptorPoolCreateInfo{.flags = flags, .maxSets = 16}.setPoolSizes(ROOM)};
}

Buffer Gpu::make_buffer(vk::DeviceSize bytes) const {
  using Usage = vk::BufferUsageFlagBits;
  constexpr vk::BufferUsageFlags USAGE = Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst;
  Buffer buffer{.owner = {device, vk::BufferCreateInfo{.size = bytes, .usage = USAGE}}};
  buffer.handle = *buffer.owner;
  buffer.memory = allocate(*this, buffer.owner,
                           vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
  buffer.bytes = {static_cast<std::byte*>(buffer.memory.mapMemory(0, VK_WHOLE_SIZE)), bytes};
  return buffer;
}

Image Gpu::make_image(vk::Format format, vk::Extent2D size, vk::SampleCountFlagBits samples, std::uint32_t layers) {
  using Usage = vk::ImageUsageFlagBits;
  const vk::ImageUsageFlags attachment = format == DEPTH ? Usage::eDepthStencilAttachment : Usage::eColorAttachment;
  const auto aspect = format == DEPTH ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
  Image image{.size = size};
  image.handle = {
      device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                  .format = format,
                                  .extent = {size.width, size.height, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = layers,
                                  .samples = samples,
                                  .usage = attachment | Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst}};
  image.memory = allocate(*this, image.handle, vk::MemoryPropertyFlagBits::eDeviceLocal);
  const auto type = layers == 1 ? vk::ImageViewType::e2D : vk::ImageViewType::e2DArray;
  const vk::ImageSubresourceRange all{aspect, 0, 1, 0, layers};
  image.view = {device, vk::ImageViewCreateInfo{
                            .image = *image.handle, .viewType = type, .format = format, .subresourceRange = all}};
  submit(graphics, [&](const Commands& commands) {
    const vk::ImageMemoryBarrier to_general{.newLayout = LAYOUT, .image = *image.handle, .subresourceRange = all};
    commands.pipelineBarrier(ALL, ALL, {}, {}, {}, to_general);
  });
  return image;
}

Pipeline Gpu::make_pipeline(const PipelineInfo& info) const {
  using Stage = vk::ShaderStageFlagBits;
  const auto images = static_cast<std::uint32_t>(info.images.size());
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  if (images != 0) bindings.push_back({0, vk::DescriptorType::eSampledImage, images, Stage::eAll});
  for (std::uint32_t i = 1; i <= info.buffers.size(); ++i)
    bindings.push_back({i, vk::DescriptorType::eStorageBuffer, 1, Stage::eAll});
  for (const VkDescriptorSetLayoutBinding& binding : info.bindings) bindings.emplace_back() = binding;
  Pipeline made{.point = info.compute.empty() ? vk::PipelineBindPoint::eGraphics : vk::PipelineBindPoint::eCompute};
  made.set_layout = {device, vk::DescriptorSetLayoutCreateInfo{}.setBindings(bindings)};
  const auto allocate = vk::DescriptorSetAllocateInfo{.descriptorPool = *descriptors_}.setSetLayouts(*made.set_layout);
  made.set = std::move(device.allocateDescriptorSets(allocate).front());
  vk::WriteDescriptorSet write{.dstSet = *made.set, .descriptorType = vk::DescriptorType::eSampledImage};
  if (images != 0) device.updateDescriptorSets(write.setImageInfo(info.images), {});
  write = {.dstSet = *made.set, .dstBinding = 1, .descriptorType = vk::DescriptorType::eStorageBuffer};
  if (!info.buffers.empty()) device.updateDescriptorSets(write.setBufferInfo(info.buffers), {});  // one a binding
  constexpr vk::PushConstantRange PUSHED{Stage::eAll, 0, 128};
  made.layout = {device, vk::PipelineLayoutCreateInfo{}.setSetLayouts(*made.set_layout).setPushConstantRanges(PUSHED)};

  std::vector<vk::raii::ShaderModule> modules;
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  for (const auto& [stage, spirv] : {std::pair(Stage::eCompute, info.compute), std::pair(Stage::eVertex, info.vertex),
                                     std::pair(Stage::eFragment, info.fragment)}) {
    if (spirv.empty()) continue;
    modules.emplace_back(device, vk::ShaderModuleCreateInfo{}.setCode(spirv));
    stages.push_back(
        {.stage = stage, .module = *modules.back(), .pName = "main", .pSpecializationInfo = &info.constants});
  }
  if (info.compute.empty())
    made.handle = make_drawing(device, info, *made.layout, stages);
  else
    made.handle = {device, nullptr, vk::ComputePipelineCreateInfo{.stage = stages.front(), .layout = *made.layout}};
  return made;
}

void Gpu::submit(std::uint32_t family, const std::function<void(const Commands&)>& record, vk::SubmitInfo info) {
  vk::raii::CommandPool pool(device, vk::CommandPoolCreateInfo{.queueFamilyIndex = family});
  vk::raii::CommandBuffers buffers(device, {.commandPool = *pool, .commandBufferCount = 1});
  const Commands& commands = buffers.front();
  commands.begin({});
  record(commands);
  barrier(commands);
  commands.end();
  device.getQueue(family, 0).submit(info.setCommandBuffers(*commands));
  submitted_.emplace_back(std::move(pool), std::move(buffers));
}

void barrier(const Commands& commands) {
  using Access = vk::AccessFlagBits;
  constexpr vk::MemoryBarrier EVERYTHING{.srcAccessMask = Access::eMemoryWrite,
                                         .dstAccessMask = Access::eMemoryWrite | Access::eMemoryRead};
  commands.pipelineBarrier(ALL, ALL | vk::PipelineStageFlagBits::eHost, {}, EVERYTHING, {}, {});
}

void read_back(const Commands& commands, const Image& image, const Buffer& to) {
  barrier(commands);
  const vk::BufferImageCopy all{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                .imageExtent = {image.size.width, image.size.height, 1}};
  commands.copyImageToBuffer(*image.handle, LAYOUT, to.handle, all);
}

void begin_rendering(const Commands& commands, const Targets& targets) {
  barrier(commands);
  const vk::RenderingAttachmentInfo color{
      .imageView = targets.color == nullptr ? vk::ImageView() : *targets.color->view,
      .imageLayout = LAYOUT,
      .loadOp = vk::AttachmentLoadOp::eClear};
  const vk::RenderingAttachmentInfo depth{
      .imageView = *targets.depth.view,
      .imageLayout = LAYOUT,
      .loadOp = targets.clear_depth ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
      .clearValue = vk::ClearDepthStencilValue{.depth = targets.clear_depth.value_or(0.0F)}};
  const vk::Extent2D size = targets.depth.size;
  vk::RenderingInfo info{
      .renderArea = {.extent = size}, .layerCount = 1, .viewMask = targets.view_mask, .pDepthAttachment = &depth};
  commands.beginRendering(targets.color == nullptr ? info : info.setColorAttachments(color));
  commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1});
  commands.setScissor(0, vk::Rect2D{.extent = size});
}
