// Finds pipelines by their description.
// SPDX-License-Identifier: Apache-2.0
#include "pipeline_store.h"

#include <algorithm>

namespace lamp::vulkan {

Result<Pipeline> PipelineStore::find_or_make(const std::string& description,
                                             const std::function<Result<Pipeline>()>& make) {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto [found, is_new] = pipelines_.try_emplace(description);
    if (is_new) break;
    if (found->second) return *found->second;
    done_.wait(lock);
  }
  lock.unlock();
  Result<Pipeline> made = make();
  lock.lock();
  if (made)
    pipelines_[description] = made.value();
  else
    pipelines_.erase(description);
  done_.notify_all();
  return made;
}

std::size_t PipelineStore::size() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::ranges::count_if(pipelines_, [](const auto& one) { return one.second.has_value(); }));
}

void Description::add(std::uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value)); }

Description& Description::operator<<(const PipelineInfo& info) {
  add(info.push_constant_bytes);
  add(info.full_subgroups ? 1 : 0);
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
        std::uint64_t{state.samples}, std::uint64_t{state.sample_mask}, std::uint64_t{state.depth},
        std::uint64_t{state.depth_write}, std::uint64_t{state.depth_clamp}, std::uint64_t{state.conservative},
        std::uint64_t{state.depth_compare}, static_cast<std::uint64_t>(state.blend)})
    add(value);
  return *this;
}

}  // namespace lamp::vulkan
