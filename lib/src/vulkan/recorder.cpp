// Barriers from uses, labels, timestamps, descriptors.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/recorder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "lamplight/vulkan/descriptor_sets.h"
#include "null_handles.h"

namespace lamp::vulkan {
namespace {

constexpr VkAccessFlags2 WRITES = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_SHADER_WRITE_BIT |
                                  VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT |
                                  VK_ACCESS_2_MEMORY_WRITE_BIT;

std::uint64_t key_of(const Resource& resource) {
  return resource.image != VK_NULL_HANDLE ? reinterpret_cast<std::uint64_t>(resource.image)
                                          : reinterpret_cast<std::uint64_t>(resource.buffer);
}

/// Calls `function` with the writes of the resources' descriptors, some at a time: none are kept on the heap.
template <class Function>
void for_each_writes(std::span<const Bound> resources, VkDescriptorSet set, Function function) {
  constexpr std::size_t MOST = 16;
  std::array<VkDescriptorBufferInfo, MOST> buffers{};
  std::array<VkDescriptorImageInfo, MOST> images{};
  std::array<VkWriteDescriptorSet, MOST> writes{};
  while (!resources.empty()) {
    const std::size_t count = std::min(resources.size(), MOST);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [binding, resource] = resources[i];
      buffers[i] = {.buffer = resource.buffer, .offset = resource.offset, .range = resource.range};
      images[i] = {.sampler = resource.sampler, .imageView = resource.view, .imageLayout = resource.layout};
      writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                   .dstSet = set,
                   .dstBinding = binding,
                   .descriptorCount = 1,
                   .descriptorType = resource.type,
                   .pImageInfo = &images[i],
                   .pBufferInfo = &buffers[i]};
    }
    function(std::span(writes).first(count));
    resources = resources.subspan(count);
  }
}

/// "GROUP: NAME", on the heap only if it is long.
class Label {
 public:
  Label(std::string_view group, std::string_view name) {
    constexpr std::string_view BETWEEN = ": ";
    const std::size_t length = name.size() + (group.empty() ? 0 : group.size() + BETWEEN.size());
    if (length >= here_.size()) long_.resize(length);
    char* at = long_.empty() ? here_.data() : long_.data();
    for (const std::string_view part : {group, group.empty() ? group : BETWEEN, name})
      at = std::ranges::copy(part, at).out;
  }
  [[nodiscard]] const char* c_str() const { return long_.empty() ? here_.data() : long_.c_str(); }

 private:
  std::array<char, 64> here_{};
  std::string long_;
};

}  // namespace

void AccessTracker::barrier(const DeviceFunctions& vk, VkCommandBuffer commands, std::span<const Use> uses) {
  VkMemoryBarrier2 memory = std::exchange(besides_, no_barrier());
  images_.clear();
  for (const Use& use : uses) {
    State& state = state_of(use.resource);
    const bool writes = (use.access & WRITES) != 0;
    const bool image = use.resource.image != VK_NULL_HANDLE;
    const bool changes_layout = image && (state.layout != use.resource.layout || use.discard);
    const bool orders_write = state.write_stages != 0 && (writes || (use.stages & ~state.visible_stages) != 0 ||
                                                          (use.access & ~state.visible_access) != 0);
    const bool orders_reads = writes && state.read_stages != 0;

    if (changes_layout) {
      images_.push_back(
          {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
           .srcStageMask = state.write_stages | state.read_stages,
           .srcAccessMask = state.write_access,
           .dstStageMask = use.stages,
           .dstAccessMask = use.access,
           .oldLayout = use.discard ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout,
           .newLayout = use.resource.layout,
           .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
           .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
           .image = use.resource.image,
           .subresourceRange = {use.resource.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}});
    } else if (orders_write || orders_reads) {
      memory.srcStageMask |= (orders_write ? state.write_stages : 0) | (orders_reads ? state.read_stages : 0);
      memory.srcAccessMask |= orders_write ? state.write_access : 0;
      // Readers join those that see the write already: each of the stages by each of the accesses.
      memory.dstStageMask |= use.stages | (writes ? VkPipelineStageFlags2{0} : state.visible_stages);
      memory.dstAccessMask |= use.access | (writes ? VkAccessFlags2{0} : state.visible_access);
    }

    if (writes || changes_layout) {
      // A layout change is a write too; what it made visible is exactly this use.
      state = {.write_stages = use.stages,
               .write_access = use.access & WRITES,
               .read_stages = writes ? VkPipelineStageFlags2{0} : use.stages,
               .visible_stages = writes ? VkPipelineStageFlags2{0} : use.stages,
               .visible_access = writes ? VkAccessFlags2{0} : use.access,
               .layout = use.resource.layout};
    } else {
      state.read_stages |= use.stages;
      state.visible_stages |= use.stages;
      state.visible_access |= use.access;
    }
  }
  if (memory.srcStageMask == 0 && images_.empty()) return;
  const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .memoryBarrierCount = memory.srcStageMask == 0 ? 0U : 1U,
                                    .pMemoryBarriers = &memory,
                                    .imageMemoryBarrierCount = static_cast<std::uint32_t>(images_.size()),
                                    .pImageMemoryBarriers = images_.data()};
  vk.vkCmdPipelineBarrier2(commands, &dependency);
}

void AccessTracker::add(const VkMemoryBarrier2& besides) {
  besides_.srcStageMask |= besides.srcStageMask;
  besides_.srcAccessMask |= besides.srcAccessMask;
  besides_.dstStageMask |= besides.dstStageMask;
  besides_.dstAccessMask |= besides.dstAccessMask;
}

AccessTracker::State& AccessTracker::state_of(const Resource& resource) {
  const std::uint64_t key = key_of(resource);
  const auto known = std::ranges::find(known_, key, &Known::key);
  return known != known_.end() ? known->state : known_.emplace_back(key).state;
}

void AccessTracker::assume(const Resource& resource) { state_of(resource) = {.layout = resource.layout}; }

void AccessTracker::forget(VkBuffer buffer) {
  std::erase_if(known_, [&](const Known& known) { return known.key == reinterpret_cast<std::uint64_t>(buffer); });
}

Result<Timestamps> Timestamps::create(const Device& device, std::uint32_t max_passes) {
  if (auto error = check_made(device)) return *error;
  if (max_passes == 0) return Error{"timestamps", "expected room for at least 1 pass, got 0"};
  Timestamps timestamps;
  const VkQueryPoolCreateInfo create{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = 2 * max_passes};
  VkQueryPool pool = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateQueryPool(device.handle, &create, nullptr, &pool); r != VK_SUCCESS)
    return Error{"timestamps", result_text(r)};
  timestamps.device_ = device.handle;
  timestamps.vk_ = device.vk;
  timestamps.pool_ = OwnedQueryPool(device.handle, pool, device.vk.vkDestroyQueryPool);
  timestamps.period_ns_ = device.timestamp_period_ns;
  timestamps.max_passes_ = max_passes;
  return timestamps;
}

void Timestamps::reset(VkCommandBuffer commands, PartOf part_of) {
  passes_.clear();
  part_of_ = std::move(part_of);
  open_ = false;
  vk_.vkCmdResetQueryPool(commands, pool_.get(), 0, 2 * max_passes_);
}

void Timestamps::begin(VkCommandBuffer commands, std::string_view pass) {
  if (open_ && part_of_(passes_.back()) == part_of_(pass)) return;
  finish(commands);
  assert(passes_.size() < max_passes_ && "create Timestamps with room for every pass of the frame");
  vk_.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(),
                           static_cast<std::uint32_t>(2 * passes_.size()));
  passes_.emplace_back(pass);
  open_ = true;
}

void Timestamps::end(VkCommandBuffer commands) {
  if (!part_of_) finish(commands);
}

void Timestamps::finish(VkCommandBuffer commands) {
  if (!open_) return;
  open_ = false;
  vk_.vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(),
                           static_cast<std::uint32_t>(2 * passes_.size() - 1));
}

std::vector<Timestamps::Time> Timestamps::read() const {
  std::vector<std::uint64_t> ticks(2 * passes_.size());
  if (!ticks.empty())
    vk_.vkGetQueryPoolResults(device_, pool_.get(), 0, static_cast<std::uint32_t>(ticks.size()),
                              ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  const auto since_first = [&](std::size_t query) {
    return static_cast<double>(ticks[query] - ticks.front()) * period_ns_ * 1e-6;
  };
  std::vector<Time> times;
  times.reserve(passes_.size());
  for (std::size_t i = 0; i < passes_.size(); ++i)
    times.push_back({.pass = passes_[i], .begin_ms = since_first(2 * i), .end_ms = since_first(2 * i + 1)});
  return times;
}

void Recorder::begin_pass(std::string_view name, std::span<const Use> uses) {
  const Label full(group_, name);
  if (device_.vk.vkCmdBeginDebugUtilsLabelEXT != nullptr) {
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, .pLabelName = full.c_str()};
    device_.vk.vkCmdBeginDebugUtilsLabelEXT(commands_, &label);
  }
  // Before the barrier: what a pass waits for is its cost. And Mesa's llvmpipe takes a time only when something flushes
  // what was recorded, which a barrier does and a dispatch that reads no image does not.
  if (timestamps_ != nullptr) timestamps_->begin(commands_, full.c_str());
  tracker_.barrier(device_.vk, commands_, uses);
}

VkMemoryBarrier2 full_barrier(VkPipelineStageFlags2 before, VkPipelineStageFlags2 after) {
  return {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
          .srcStageMask = before,
          .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
          .dstStageMask = after,
          .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
}

void Recorder::order(const VkMemoryBarrier2& barrier) {
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  device_.vk.vkCmdPipelineBarrier2(commands_, &dependency);
}

void Recorder::end_pass() {
  if (timestamps_ != nullptr) timestamps_->end(commands_);
  if (device_.vk.vkCmdEndDebugUtilsLabelEXT != nullptr) device_.vk.vkCmdEndDebugUtilsLabelEXT(commands_);
}

void Recorder::bind(const Pipeline& pipeline, std::span<const Bound> resources) {
  bound_.clear();
  device_.vk.vkCmdBindPipeline(commands_, pipeline.bind_point(), pipeline.handle());
  push(pipeline, resources);
}

void Recorder::bind(const Pipeline& pipeline, std::span<const Bound> resources, VkDescriptorSet set) {
  device_.vk.vkCmdBindPipeline(commands_, pipeline.bind_point(), pipeline.handle());
  if (set == VK_NULL_HANDLE)
    push_writes(pipeline, resources);
  else
    bind_set(pipeline, resources, set);
}

void Recorder::push(const Pipeline& pipeline, std::span<const Bound> resources) {
  if (device_.pushes_descriptors()) return push_writes(pipeline, resources);
  assert(device_.sets != nullptr && "set Device::sets where push descriptors are not enabled");
  for (const Bound& bound : resources) {
    const auto before = std::ranges::find(bound_, bound.binding, &Bound::binding);
    if (before == bound_.end())
      bound_.push_back(bound);
    else
      *before = bound;
  }
  if (const Result<VkDescriptorSet> set = device_.sets->allocate(pipeline)) bind_set(pipeline, bound_, set.value());
}

void Recorder::push_writes(const Pipeline& pipeline, std::span<const Bound> resources) const {
  for_each_writes(resources, VK_NULL_HANDLE, [&](std::span<const VkWriteDescriptorSet> writes) {
    device_.vk.vkCmdPushDescriptorSetKHR(commands_, pipeline.bind_point(), pipeline.layout(), 0,
                                         static_cast<std::uint32_t>(writes.size()), writes.data());
  });
}

void Recorder::bind_set(const Pipeline& pipeline, std::span<const Bound> resources, VkDescriptorSet set) const {
  for_each_writes(resources, set, [&](std::span<const VkWriteDescriptorSet> writes) {
    device_.vk.vkUpdateDescriptorSets(device_.handle, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                                      nullptr);
  });
  device_.vk.vkCmdBindDescriptorSets(commands_, pipeline.bind_point(), pipeline.layout(), 0, 1, &set, 0, nullptr);
}

}  // namespace lamp::vulkan
