// The device, its memory, submission, pipelines, drawing.
// SPDX-License-Identifier: Apache-2.0
#include "gpu.h"

#include <algorithm>
#include <array>

namespace {

constexpr vk::QueueFlags DRAWS_AND_COMPUTES = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
constexpr auto ALL = vk::PipelineStageFlagBits::eAllCommands;
constexpr auto LAYOUT = vk::ImageLayout::eGeneral;  // of all images

/// For a buffer or an image. Vulkan promises memory with each of the properties that are asked for below.
template <class T>
vk::raii::DeviceMemory allocate(const Gpu& gpu, const T& object, vk::MemoryPropertyFlags properties) {
  const vk::MemoryRequirements needs = object.getMemoryRequirements();
  const vk::PhysicalDeviceMemoryProperties memory = gpu.physical.getMemoryProperties();
  std::uint32_t type = 0;
  while ((needs.memoryTypeBits >> type & 1U) == 0 ||
         (memory.memoryTypes.at(type).propertyFlags & properties) != properties)
    ++type;
  vk::raii::DeviceMemory made(gpu.device,
                              vk::MemoryAllocateInfo{.allocationSize = needs.size, .memoryTypeIndex = type});
  object.bindMemory(*made, 0);
  return made;
}

void write(const vk::raii::Device& device, vk::DescriptorSet set, const Descriptor& descriptor) {
  vk::WriteDescriptorSet write{.dstSet = set, .dstBinding = descriptor.binding};
  const vk::DescriptorBufferInfo buffer{.buffer = descriptor.buffer, .range = VK_WHOLE_SIZE};
  std::vector<vk::DescriptorImageInfo> images;
  for (const vk::ImageView view : descriptor.views) images.push_back({.imageView = view, .imageLayout = LAYOUT});
  if (images.empty())
    write.setDescriptorType(vk::DescriptorType::eStorageBuffer).setBufferInfo(buffer);
  else
    write.setDescriptorType(vk::DescriptorType::eSampledImage).setImageInfo(images);
  device.updateDescriptorSets(write, {});
}

vk::raii::Pipeline make_drawing(const vk::raii::Device& device, const PipelineInfo& info, vk::PipelineLayout layout,
                                const std::vector<vk::PipelineShaderStageCreateInfo>& stages) {
  const std::uint32_t colors = info.fragment.empty() ? 0 : 1;
  const vk::PipelineRenderingCreateInfo rendering{.viewMask = info.view_mask,
                                                  .colorAttachmentCount = colors,
                                                  .pColorAttachmentFormats = &COLOR,
                                                  .depthAttachmentFormat = DEPTH};
  const vk::PipelineVertexInputStateCreateInfo input;
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1.0F};
  const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples = info.samples};
  const vk::PipelineDepthStencilStateCreateInfo depth{
      .depthTestEnable = VK_TRUE, .depthWriteEnable = VK_TRUE, .depthCompareOp = info.depth_compare};
  const vk::PipelineColorBlendAttachmentState color{.colorWriteMask = vk::ColorComponentFlags(0xF)};
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = colors, .pAttachments = &color};
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
  const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
  const auto find = [&](vk::QueueFlags flags) {
    std::uint32_t family = 0;
    while (family < families.size() && (families[family].queueFlags & DRAWS_AND_COMPUTES) != flags) ++family;
    return family;
  };
  graphics = find(DRAWS_AND_COMPUTES);
  compute = find(vk::QueueFlagBits::eCompute);
  if (compute == families.size()) compute = graphics;
  constexpr float PRIORITY = 1.0F;
  std::vector<vk::DeviceQueueCreateInfo> queues;  // of each family one
  for (std::uint32_t family = 0; family < families.size(); ++family)
    queues.push_back(vk::DeviceQueueCreateInfo{.queueFamilyIndex = family}.setQueuePriorities(PRIORITY));
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
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const Descriptor& d : info.descriptors) {
    const auto type = d.views.empty() ? vk::DescriptorType::eStorageBuffer : vk::DescriptorType::eSampledImage;
    const auto count = std::max(1U, static_cast<std::uint32_t>(d.views.size()));
    bindings.push_back({d.binding, type, count, vk::ShaderStageFlagBits::eAll});
  }
  for (const VkDescriptorSetLayoutBinding& binding : info.bindings) bindings.emplace_back() = binding;
  Pipeline made{.point = info.compute.empty() ? vk::PipelineBindPoint::eGraphics : vk::PipelineBindPoint::eCompute};
  made.set_layout = {device, vk::DescriptorSetLayoutCreateInfo{}.setBindings(bindings)};
  const auto allocate = vk::DescriptorSetAllocateInfo{.descriptorPool = *descriptors_}.setSetLayouts(*made.set_layout);
  made.set = std::move(device.allocateDescriptorSets(allocate).front());
  for (const Descriptor& d : info.descriptors) write(device, *made.set, d);
  constexpr vk::PushConstantRange PUSHED{vk::ShaderStageFlagBits::eAll, 0, 128};
  made.layout = {device, vk::PipelineLayoutCreateInfo{}.setSetLayouts(*made.set_layout).setPushConstantRanges(PUSHED)};

  vk::SpecializationInfo constants;
  constants = info.constants;
  std::vector<vk::raii::ShaderModule> modules;
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  using Stage = vk::ShaderStageFlagBits;
  for (const auto& [stage, spirv] : {std::pair(Stage::eCompute, info.compute), std::pair(Stage::eVertex, info.vertex),
                                     std::pair(Stage::eFragment, info.fragment)}) {
    if (spirv.empty()) continue;
    modules.emplace_back(device, vk::ShaderModuleCreateInfo{.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
    stages.push_back({.stage = stage, .module = *modules.back(), .pName = "main", .pSpecializationInfo = &constants});
  }
  if (info.compute.empty())
    made.handle = make_drawing(device, info, *made.layout, stages);
  else
    made.handle = {device, nullptr, vk::ComputePipelineCreateInfo{.stage = stages.front(), .layout = *made.layout}};
  return made;
}

void Gpu::submit(std::uint32_t family, const std::function<void(const Commands&)>& record, vk::Semaphore wait_for,
                 vk::Semaphore signal) {
  vk::raii::CommandPool pool(device, vk::CommandPoolCreateInfo{.queueFamilyIndex = family});
  vk::raii::CommandBuffers buffers(device,
                                   vk::CommandBufferAllocateInfo{.commandPool = *pool, .commandBufferCount = 1});
  const Commands& commands = buffers.front();
  commands.begin({});
  record(commands);
  barrier(commands);
  commands.end();
  constexpr vk::PipelineStageFlags STAGES = ALL;
  auto info = vk::SubmitInfo{}.setCommandBuffers(*commands);
  if (wait_for) info.setWaitSemaphores(wait_for).setWaitDstStageMask(STAGES);
  if (signal) info.setSignalSemaphores(signal);
  device.getQueue(family, 0).submit(info);
  submitted_.emplace_back(std::move(pool), std::move(buffers));
}

void Gpu::wait() {
  device.waitIdle();
  submitted_.clear();
}

void barrier(const Commands& commands) {
  constexpr auto WRITES = vk::AccessFlagBits::eMemoryWrite;
  constexpr vk::MemoryBarrier EVERYTHING{.srcAccessMask = WRITES,
                                         .dstAccessMask = WRITES | vk::AccessFlagBits::eMemoryRead};
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
  vk::RenderingAttachmentInfo depth{
      .imageView = *targets.depth.view, .imageLayout = LAYOUT, .loadOp = targets.depth_load};
  depth.clearValue.depthStencil.depth = targets.clear_depth;
  const vk::Extent2D size = targets.depth.size;
  vk::RenderingInfo info{
      .renderArea = {.extent = size}, .layerCount = 1, .viewMask = targets.view_mask, .pDepthAttachment = &depth};
  vk::RenderingAttachmentInfo color{.imageLayout = LAYOUT, .loadOp = vk::AttachmentLoadOp::eClear};
  if (targets.color != nullptr) {
    color.imageView = *targets.color->view;
    info.setColorAttachments(color);
  }
  commands.beginRendering(info);
  commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1});
  commands.setScissor(0, vk::Rect2D{.extent = size});
}
