// Finds pipelines by their description.
// SPDX-License-Identifier: Apache-2.0
#include "pipeline_store.h"

namespace lamp::vulkan {

std::optional<Pipeline> PipelineStore::find(const std::string& description) const {
  const std::lock_guard lock(mutex_);
  const auto found = pipelines_.find(description);
  return found == pipelines_.end() ? std::nullopt : std::optional(found->second);
}

void PipelineStore::add(const std::string& description, const Pipeline& pipeline) {
  const std::lock_guard lock(mutex_);
  pipelines_.try_emplace(description, pipeline);
}

std::size_t PipelineStore::size() const {
  const std::lock_guard lock(mutex_);
  return pipelines_.size();
}

void Description::add(std::uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value)); }

Description& Description::operator<<(const PipelineInfo& info) {
  add(info.push_constant_bytes);
  add(info.constants.size());
  for (const Constant& constant : info.constants) {
    add(constant.id);
    add(constant.value);
  }
  add(info.bindings.size());
  for (const DescriptorBinding& binding : info.bindings) {
    add(binding.binding);
    add(binding.type);
  }
  return *this;
}

Description& Description::operator<<(std::span<const std::uint32_t> spirv) {
  add(spirv.size());
  bytes_.append(reinterpret_cast<const char*>(spirv.data()), spirv.size_bytes());
  return *this;
}

Description& Description::operator<<(const GraphicsState& state) {
  add(state.attributes.size());
  for (const VkVertexInputAttributeDescription& attribute : state.attributes)
    for (const std::uint64_t value :
         {attribute.location, attribute.binding, static_cast<std::uint32_t>(attribute.format), attribute.offset})
      add(value);
  add(state.colors.size());
  for (const VkFormat format : state.colors) add(format);
  for (const std::uint64_t value :
       {std::uint64_t{state.vertex_bytes}, std::uint64_t{state.cull}, std::uint64_t{state.dynamic_cull},
        std::uint64_t{state.samples}, std::uint64_t{state.depth}, std::uint64_t{state.depth_write},
        std::uint64_t{state.depth_clamp}, std::uint64_t{state.conservative}, std::uint64_t{state.depth_compare},
        static_cast<std::uint64_t>(state.blend)})
    add(value);
  return *this;
}

}  // namespace lamp::vulkan
