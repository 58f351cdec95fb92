// Makes pipelines from passes.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/pass_pipeline.h"

#include "lamplight/shader_code.h"

namespace lamp::vulkan {
namespace {

PipelineInfo pipeline_info(const Pass& pass) {
  PipelineInfo info{.name = pass.name, .full_subgroups = pass.full_subgroups != 0};
  for (std::uint32_t i = 0; i < pass.constants.size(); ++i) info.constants.push_back({i, pass.constants[i]});
  for (std::uint32_t i = 0; i < pass.bindings.size(); ++i)
    info.bindings.push_back({i, descriptor_type(pass.bindings[i].resource, pass)});
  return info;
}

GraphicsState graphics_state(const RasterState& raster) {
  constexpr VkCullModeFlags CULL[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT};
  return {.cull = CULL[static_cast<int>(raster.cull)],
          .samples = static_cast<VkSampleCountFlagBits>(raster.samples),
          .conservative = raster.conservative};
}

}  // namespace

Result<std::vector<std::uint32_t>> embedded_shaders(std::string_view name) {
  const ShaderCode* code = find_shader(library_shaders(), name);
  if (code == nullptr) return Error{"shader " + std::string(name), "is not among the library's shaders"};
  return std::vector<std::uint32_t>(code->spirv.begin(), code->spirv.end());
}

Result<Pipeline> make_pipeline(const Device& device, const Pass& pass, const ShaderSource& shaders) {
  if (pass.kind == PassKind::host) return Pipeline();
  const auto shader = shaders(pass.shader);
  if (!shader) return shader.error();
  if (pass.kind == PassKind::compute) return Pipeline::compute(device, pipeline_info(pass), shader.value());
  const auto vertex = shaders(pass.raster.vertex_shader);
  if (!vertex) return vertex.error();
  return Pipeline::graphics(device, pipeline_info(pass), vertex.value(), shader.value(), graphics_state(pass.raster));
}

VkDescriptorType descriptor_type(ResourceId id) {
  return id == INPUT_DEPTH ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

// Constants are no loads on some GPUs. Not of raster passes: llvmpipe's fragment shaders go wrong where they branch on
// what they read from a uniform buffer.
VkDescriptorType descriptor_type(ResourceId id, const Pass& pass) {
  const bool is_constant = id == INPUT_FRAME && pass.kind == PassKind::compute;
  return is_constant ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : descriptor_type(id);
}

std::vector<Constant> lookup_constants(const LookUp& lookup) {
  std::vector<Constant> constants;
  for (std::uint32_t i = 0; i < lookup.constants.size(); ++i)
    constants.push_back({LOOKUP_CONSTANT + i, lookup.constants[i]});
  for (std::uint32_t i = 0; i < lookup.view_words.size(); ++i)
    constants.push_back({LOOKUP_VIEW_CONSTANT + i, lookup.view_words[i]});
  return constants;
}

std::vector<DescriptorBinding> lookup_bindings(const LookUp& lookup) {
  std::vector<DescriptorBinding> bindings;
  for (std::uint32_t i = 0; i < lookup.bindings.size(); ++i)
    bindings.push_back({LOOKUP_BINDING + i, descriptor_type(lookup.bindings[i].resource)});
  return bindings;
}

}  // namespace lamp::vulkan
