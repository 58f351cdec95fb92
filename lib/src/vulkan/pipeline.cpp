// Builds pipelines: one descriptor set, pushed or not, optional push constants, specialization constants by id.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/pipeline.h"

#include <array>

#include "null_handles.h"
#include "pipeline_store.h"

namespace lamp::vulkan {
namespace {

/// Specialization constants in the form Vulkan wants; refers to the list it was made from.
class Specialization {
 public:
  explicit Specialization(const std::vector<Constant>& constants) {
    for (std::uint32_t i = 0; i < constants.size(); ++i)
      entries_.push_back({.constantID = constants[i].id,
                          .offset = static_cast<std::uint32_t>(i * sizeof(Constant) + offsetof(Constant, value)),
                          .size = sizeof(std::uint32_t)});
    info_ = {.mapEntryCount = static_cast<std::uint32_t>(entries_.size()),
             .pMapEntries = entries_.data(),
             .dataSize = constants.size() * sizeof(Constant),
             .pData = constants.data()};
  }
  [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; }

 private:
  std::vector<VkSpecializationMapEntry> entries_;
  VkSpecializationInfo info_{};
};

Result<OwnedShaderModule> make_module(const Device& device, const std::string& name,
                                      std::span<const std::uint32_t> spirv) {
  const VkShaderModuleCreateInfo create{
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = spirv.size_bytes(), .pCode = spirv.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateShaderModule(device.handle, &create, nullptr, &module); r != VK_SUCCESS)
    return Error{"shader " + name, result_text(r)};
  return OwnedShaderModule(device.handle, module, device.vk.vkDestroyShaderModule);
}

VkPipelineCreateFlags creation_flags(const Device& device) {
  return device.pipeline_statistics ? VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR : 0;
}

/// Every index in a shader is below a capacity of the plan, so buffers need no checks. They cost an H200 4 % of the
/// cull of a million lights by `lamplight`, 17 % of that by `tiled`, 2 % of shading.
class Robustness {
 public:
  Robustness(const Device& device, const void* next) : wanted_(device.pipeline_robustness) { info_.pNext = next; }
  [[nodiscard]] const void* chain() const { return wanted_ ? &info_ : info_.pNext; }

 private:
  VkPipelineRobustnessCreateInfoEXT info_{.sType = VK_STRUCTURE_TYPE_PIPELINE_ROBUSTNESS_CREATE_INFO_EXT,
                                          .storageBuffers = VK_PIPELINE_ROBUSTNESS_BUFFER_BEHAVIOR_DISABLED_EXT,
                                          .uniformBuffers = VK_PIPELINE_ROBUSTNESS_BUFFER_BEHAVIOR_DISABLED_EXT};
  bool wanted_;
};

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, const OwnedShaderModule& module,
                                           const Specialization& specialization) {
  return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = stage,
          .module = module.get(),
          .pName = "main",
          .pSpecializationInfo = specialization.info()};
}

VkPipelineColorBlendAttachmentState blend_state(GraphicsState::Blend blend) {
  VkPipelineColorBlendAttachmentState state{.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                              VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
  if (blend == GraphicsState::Blend::none) return state;
  const bool over = blend == GraphicsState::Blend::over;
  state.blendEnable = VK_TRUE;
  state.srcColorBlendFactor = over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
  state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  return state;
}

/// The state objects of a graphics pipeline, which point into each other; built in place, used once.
struct GraphicsCreate {
  VkVertexInputBindingDescription vertex_binding{};
  VkPipelineVertexInputStateCreateInfo vertex{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationConservativeStateCreateInfoEXT conservative{};
  VkPipelineRasterizationStateCreateInfo raster{};
  std::array<VkSampleMask, 2> sample_mask;
  VkPipelineMultisampleStateCreateInfo multisample{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  std::vector<VkPipelineColorBlendAttachmentState> blends;
  VkPipelineColorBlendStateCreateInfo blend{};
  std::vector<VkDynamicState> dynamics;
  VkPipelineDynamicStateCreateInfo dynamic{};
  VkPipelineRenderingCreateInfo rendering{};
  VkGraphicsPipelineCreateInfo info{};

  explicit GraphicsCreate(const GraphicsState& state) : sample_mask{state.sample_mask, ~0U} {
    vertex_binding = {.stride = state.vertex_bytes};
    vertex = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
              .vertexBindingDescriptionCount = state.attributes.empty() ? 0U : 1U,
              .pVertexBindingDescriptions = &vertex_binding,
              .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(state.attributes.size()),
              .pVertexAttributeDescriptions = state.attributes.data()};
    assembly = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    viewport = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                .viewportCount = state.viewports,
                .scissorCount = state.viewports};
    conservative = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_CONSERVATIVE_STATE_CREATE_INFO_EXT,
                    .conservativeRasterizationMode = VK_CONSERVATIVE_RASTERIZATION_MODE_OVERESTIMATE_EXT};
    raster = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
              .pNext = state.conservative ? &conservative : nullptr,
              .depthClampEnable = state.depth_clamp ? VK_TRUE : VK_FALSE,
              .polygonMode = VK_POLYGON_MODE_FILL,
              .cullMode = state.cull,
              .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
              .lineWidth = 1.0F};
    multisample = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                   .rasterizationSamples = state.samples,
                   .pSampleMask = sample_mask.data()};
    depth = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
             .depthTestEnable = state.depth != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE,
             .depthWriteEnable = state.depth_write ? VK_TRUE : VK_FALSE,
             .depthCompareOp = state.depth_compare};
    blends.assign(state.colors.size(), blend_state(state.blend));
    blend = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
             .attachmentCount = static_cast<std::uint32_t>(blends.size()),
             .pAttachments = blends.data()};
    dynamics = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    if (state.dynamic_cull) dynamics.push_back(VK_DYNAMIC_STATE_CULL_MODE);
    dynamic = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
               .dynamicStateCount = static_cast<std::uint32_t>(dynamics.size()),
               .pDynamicStates = dynamics.data()};
    rendering = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                 .colorAttachmentCount = static_cast<std::uint32_t>(state.colors.size()),
                 .pColorAttachmentFormats = state.colors.data(),
                 .depthAttachmentFormat = state.depth};
    info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
            .pNext = &rendering,
            .pVertexInputState = &vertex,
            .pInputAssemblyState = &assembly,
            .pViewportState = &viewport,
            .pRasterizationState = &raster,
            .pMultisampleState = &multisample,
            .pDepthStencilState = &depth,
            .pColorBlendState = &blend,
            .pDynamicState = &dynamic};
  }
  GraphicsCreate(const GraphicsCreate&) = delete;
  GraphicsCreate& operator=(const GraphicsCreate&) = delete;
};

/// `objects`: a Pipeline's.
void finish(const Device& device, const std::string& name, VkPipeline handle, auto& objects) {
  objects.pipeline = OwnedPipeline(device.handle, handle, device.vk.vkDestroyPipeline);
  objects.statistics = read_statistics(device, handle);
  device.name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(handle), name);
}

}  // namespace

std::optional<Error> Pipeline::make_layout(const Device& device, const PipelineInfo& info, Objects& out) {
  out.name = info.name;
  out.bindings = info.bindings;
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const DescriptorBinding& binding : info.bindings)
    bindings.push_back({.binding = binding.binding,
                        .descriptorType = binding.type,
                        .descriptorCount = 1,
                        .stageFlags = VK_SHADER_STAGE_ALL});
  const VkDescriptorSetLayoutCreateFlags flags =
      device.pushes_descriptors() ? VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR : 0;
  const VkDescriptorSetLayoutCreateInfo set_create{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                   .flags = flags,
                                                   .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                   .pBindings = bindings.data()};
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateDescriptorSetLayout(device.handle, &set_create, nullptr, &set_layout);
      r != VK_SUCCESS)
    return Error{"pipeline " + info.name, result_text(r)};
  out.set_layout = OwnedSetLayout(device.handle, set_layout, device.vk.vkDestroyDescriptorSetLayout);

  const VkPushConstantRange range{.stageFlags = VK_SHADER_STAGE_ALL, .size = info.push_constant_bytes};
  const VkPipelineLayoutCreateInfo create{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set_layout,
                                          .pushConstantRangeCount = info.push_constant_bytes == 0 ? 0U : 1U,
                                          .pPushConstantRanges = &range};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreatePipelineLayout(device.handle, &create, nullptr, &layout); r != VK_SUCCESS)
    return Error{"pipeline " + info.name, result_text(r)};
  out.layout = OwnedPipelineLayout(device.handle, layout, device.vk.vkDestroyPipelineLayout);
  return std::nullopt;
}

Result<Pipeline> Pipeline::make_compute(const Device& device, const PipelineInfo& info,
                                        std::span<const std::uint32_t> spirv) {
  Objects objects;
  if (auto error = make_layout(device, info, objects)) return *error;
  const Result<OwnedShaderModule> module = make_module(device, info.name, spirv);
  if (!module) return module.error();
  const Specialization specialization(info.constants);
  const Robustness robustness(device, nullptr);
  VkPipelineShaderStageCreateInfo stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, module.value(), specialization);
  if (info.full_subgroups) stage.flags |= VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  const VkComputePipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .pNext = robustness.chain(),
                                           .flags = creation_flags(device),
                                           .stage = stage,
                                           .layout = objects.layout.get()};
  VkPipeline handle = VK_NULL_HANDLE;
  if (const VkResult r =
          device.vk.vkCreateComputePipelines(device.handle, device.pipeline_cache, 1, &create, nullptr, &handle);
      r != VK_SUCCESS)
    return Error{"pipeline " + info.name, result_text(r)};
  finish(device, info.name, handle, objects);
  return Pipeline(std::move(objects));
}

Result<Pipeline> Pipeline::make_graphics(const Device& device, const PipelineInfo& info,
                                         std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                         const GraphicsState& state) {
  Objects objects;
  objects.bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  if (auto error = make_layout(device, info, objects)) return *error;
  const Specialization specialization(info.constants);
  std::vector<OwnedShaderModule> modules;
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  const std::pair<VkShaderStageFlagBits, std::span<const std::uint32_t>> sources[] = {
      {VK_SHADER_STAGE_VERTEX_BIT, vertex}, {VK_SHADER_STAGE_FRAGMENT_BIT, fragment}};
  for (const auto& [stage, spirv] : sources) {
    if (spirv.empty()) continue;
    Result<OwnedShaderModule> module = make_module(device, info.name, spirv);
    if (!module) return module.error();
    modules.push_back(std::move(module.value()));
    stages.push_back(stage_info(stage, modules.back(), specialization));
  }
  GraphicsCreate create(state);
  const Robustness robustness(device, create.info.pNext);
  create.info.pNext = robustness.chain();
  create.info.flags = creation_flags(device);
  create.info.stageCount = static_cast<std::uint32_t>(stages.size());
  create.info.pStages = stages.data();
  create.info.layout = objects.layout.get();
  VkPipeline handle = VK_NULL_HANDLE;
  if (const VkResult r =
          device.vk.vkCreateGraphicsPipelines(device.handle, device.pipeline_cache, 1, &create.info, nullptr, &handle);
      r != VK_SUCCESS)
    return Error{"pipeline " + info.name, result_text(r)};
  finish(device, info.name, handle, objects);
  return Pipeline(std::move(objects));
}

Result<Pipeline> Pipeline::compute(const Device& device, const PipelineInfo& info,
                                   std::span<const std::uint32_t> spirv) {
  if (auto error = check_made(device)) return *error;
  if (spirv.empty()) return Error{"pipeline " + info.name, "expected SPIR-V, got none"};
  const auto make = [&] { return make_compute(device, info, spirv); };
  if (device.pipelines == nullptr) return make();
  return device.pipelines->find_or_make((Description(device) << info << spirv).bytes(), make);
}

Result<Pipeline> Pipeline::graphics(const Device& device, const PipelineInfo& info,
                                    std::span<const std::uint32_t> vertex, std::span<const std::uint32_t> fragment,
                                    const GraphicsState& state) {
  if (auto error = check_made(device)) return *error;
  const auto make = [&] { return make_graphics(device, info, vertex, fragment, state); };
  if (device.pipelines == nullptr) return make();
  return device.pipelines->find_or_make((Description(device) << info << vertex << fragment << state).bytes(), make);
}

}  // namespace lamp::vulkan
