// Binds a plan's passes once, and records them: zeros first, then what may run side by side together.
// Promise: recording allocates nothing.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "lamplight/vulkan/plan_runner.h"
#include "pass_use.h"

namespace lamp::vulkan {
namespace {

std::array<std::uint32_t, 3> counts_of(const Extent& extent, const shared::Frame& frame) {
  const auto counts = extent.counts(frame.size_px.x, frame.size_px.y, frame.light_count);
  return {static_cast<std::uint32_t>(counts[0]), static_cast<std::uint32_t>(counts[1]),
          static_cast<std::uint32_t>(counts[2])};
}

/// Of a view's part of a buffer that is zeroed, what its picture takes.
std::uint64_t zeroed_bytes(const BufferDesc& desc, const shared::Frame& frame) {
  if (desc.zeroed_cells.px == 0) return desc.bytes;
  return std::min(desc.bytes, desc.zeroed_cells.count(frame.size_px.x, frame.size_px.y) * desc.cell_bytes);
}

bool writes(const Use& use) { return (use.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0; }

bool overlap(const Resource& a, const Resource& b) {
  return a.buffer == b.buffer && a.offset < b.offset + b.range && b.offset < a.offset + a.range;
}

/// Whether one must wait for the other. Inputs are read alone.
bool depends(std::span<const Use> later, std::span<const Use> earlier) {
  return std::ranges::any_of(later, [&](const Use& use) {
    return use.resource.buffer != VK_NULL_HANDLE && std::ranges::any_of(earlier, [&](const Use& other) {
             return overlap(use.resource, other.resource) && (writes(use) || writes(other));
           });
  });
}

/// One use of each resource in each way: what views touch, they touch alike.
void add_uses(std::vector<Use>& to, std::span<const Use> uses) {
  for (const Use& use : uses)
    if (std::ranges::none_of(to, [&](const Use& other) {
          return other.resource.buffer == use.resource.buffer && other.resource.image == use.resource.image &&
                 other.stages == use.stages && other.access == use.access;
        }))
      to.push_back(use);
}

}  // namespace

BufferPart PlanRunner::part(ResourceId id, std::uint32_t view, std::uint32_t slot) const {
  const BufferDesc& desc = plan_.buffers[id - PLAN_BUFFER];
  const std::uint64_t begin = desc.memory == BufferMemory::counts ? slot * plan_.all_bytes(desc) : 0;
  return {buffer(id), begin + (desc.all_views ? 0 : view * plan_.view_bytes(desc)), desc.bytes};
}

Resource PlanRunner::resource(ResourceId id, const PlanInputs& inputs, std::uint32_t view) const {
  if (id >= PLAN_BUFFER) return Resource::storage(part(id, view, inputs.slot));
  if (id == INPUT_FRAME)
    return Resource::storage(
        {inputs.frame.buffer, inputs.frame.offset + view * sizeof(shared::Frame), sizeof(shared::Frame)});
  if (id != INPUT_DEPTH) return all_views(id, inputs);
  Resource depth = inputs.depths.empty() ? inputs.depth : inputs.depths[view];
  depth.type = descriptor_type(id);
  depth.sampler = depth_sampler_.get();
  return depth;
}

Resource PlanRunner::all_views(ResourceId id, const PlanInputs& inputs) const {
  switch (id) {
    case INPUT_FRAME:
      return Resource::storage({inputs.frame.buffer, inputs.frame.offset, plan_.views * sizeof(shared::Frame)});
    case INPUT_LIGHTS:
      return Resource::storage(inputs.lights);
    case INPUT_CONES:
      return Resource::storage(inputs.cones);
    case INPUT_SPHERES:
      return Resource::storage(inputs.spheres);
    case INPUT_RADIAL:
      return Resource::storage(inputs.radial);
    case INPUT_MESHES:
      return Resource::storage(inputs.meshes);
    case INPUT_STILL:
      return Resource::storage(inputs.still.buffer != VK_NULL_HANDLE ? inputs.still
                                                                     : BufferPart(every_light_.handle()));
    default:
      return id == INPUT_DEPTH ? resource(id, inputs, 0) : Resource::storage(buffer(id));
  }
}

/// With the plan's own buffers. Inputs, which nothing writes, come with each frame, and so does the slot of counters.
void PlanRunner::bind_all(Sequence& sequence) const {
  for (std::size_t i = 0; i < sequence.passes.size(); ++i) {
    const Pass& pass = sequence.passes[i].pass;
    for (std::uint32_t view = 0; view < (pass.once ? 1 : plan_.views) && pass.kind != PassKind::host; ++view) {
      BoundPass bound{.pass = i, .view = view};
      for (std::uint32_t b = 0; b < pass.bindings.size(); ++b) {
        Resource used = resource(pass.bindings[b].resource, {}, view);
        used.type = descriptor_type(pass.bindings[b].resource, pass);
        bound.uses.push_back(use_of(used, pass.bindings[b].access, shader_stages(pass)));
        bound.resources.push_back({b, used});
      }
      if (pass.extent.indirect != NO_RESOURCE)
        bound.uses.push_back({.resource = Resource::storage(part(pass.extent.indirect, view, 0)),
                              .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                              .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
      const std::size_t place = sequence.bound.size();
      const std::size_t first = sequence.together.empty() ? place : sequence.together.back().begin;
      const bool waits = std::any_of(sequence.bound.begin() + static_cast<std::ptrdiff_t>(first), sequence.bound.end(),
                                     [&](const BoundPass& one) { return depends(bound.uses, one.uses); });
      if (waits || sequence.together.empty()) sequence.together.push_back({place, place});
      sequence.together.back().end = place + 1;
      sequence.bound.push_back(std::move(bound));
    }
  }
}

void PlanRunner::bind_inputs(Sequence& sequence, const PlanInputs& inputs) const {
  for (BoundPass& bound : sequence.bound) {
    const Pass& pass = sequence.passes[bound.pass].pass;
    for (std::size_t b = 0; b < pass.bindings.size(); ++b) {
      const ResourceId id = pass.bindings[b].resource;
      if (id >= PLAN_BUFFER && id != plan_.counters) continue;
      Resource used = resource(id, inputs, bound.view);
      used.type = descriptor_type(id, pass);
      bound.uses[b] = use_of(used, pass.bindings[b].access, shader_stages(pass));
      bound.resources[b].resource = used;
    }
  }
}

void PlanRunner::zero_buffers(Recorder& recorder, const PlanInputs& inputs) {
  uses_.clear();
  for (std::size_t i = 0; i < buffers_.size(); ++i)
    if (plan_.buffers[i].zeroed)
      uses_.push_back({.resource = Resource::storage(buffers_[i].handle()),
                       .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                       .access = VK_ACCESS_2_TRANSFER_WRITE_BIT});
  if (uses_.empty()) return;
  recorder.begin_pass(CLEAR_PASS, uses_);
  for (ResourceId id = PLAN_BUFFER; id < PLAN_BUFFER + buffers_.size(); ++id) {
    const BufferDesc& desc = plan_.buffers[id - PLAN_BUFFER];
    for (std::uint32_t view = 0; view < plan_.views && desc.zeroed; ++view)
      recorder.device().vk.vkCmdFillBuffer(recorder.commands(), buffer(id), part(id, view, inputs.slot).offset,
                                           zeroed_bytes(desc, inputs.host_frame[view]), 0);
  }
  recorder.end_pass();
}

void PlanRunner::record_together(Recorder& recorder, const Sequence& sequence, const Range& range,
                                 const PlanInputs& inputs) {
  uses_.clear();  // of all, before the first of them, so that no barrier keeps them apart
  std::array<bool, MAX_VIEWS> kept{};
  const auto is_recorded = [&](const BoundPass& bound) {
    return !sequence.passes[bound.pass].pass.on_projection_change || !kept[bound.view];
  };
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const BoundPass& bound = sequence.bound[i];
    if (sequence.passes[bound.pass].pass.on_projection_change)
      kept[bound.view] = is_kept(bound.view, inputs.host_frame[bound.view], records_);
    if (is_recorded(bound)) add_uses(uses_, bound.uses);
  }
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const BoundPass& bound = sequence.bound[i];
    const BuiltPass& built = sequence.passes[bound.pass];
    if (!is_recorded(bound)) continue;
    if (built.pass.on_projection_change) ++projection_rebuilds_;
    recorder.begin_pass(built.pass.name, uses_);
    uses_.clear();
    const BuiltPass::Sized& sized = built.of_shift(inputs.host_frame[bound.view].cell_shift);
    recorder.bind(sized.pipeline, bound.resources, set(built, inputs.slot, bound.view));
    if (built.pass.kind == PassKind::raster)
      draw(recorder, built.pass, inputs, bound.view);
    else
      dispatch(recorder, sized.extent, inputs, bound.view);
    recorder.end_pass();
  }
}

void PlanRunner::dispatch(const Recorder& recorder, const Extent& extent, const PlanInputs& inputs,
                          std::uint32_t view) const {
  const DeviceFunctions& vk = recorder.device().vk;
  const VkCommandBuffer commands = recorder.commands();
  if (extent.indirect != NO_RESOURCE) {
    const BufferPart counts = part(extent.indirect, view, inputs.slot);
    return vk.vkCmdDispatchIndirect(commands, counts.buffer, counts.offset + extent.indirect_offset);
  }
  const auto [x, y, z] = counts_of(extent, inputs.host_frame[view]);
  if (x != 0) vk.vkCmdDispatch(commands, x, y, z);
}

void PlanRunner::draw(const Recorder& recorder, const Pass& pass, const PlanInputs& inputs, std::uint32_t view) const {
  const DeviceFunctions& vk = recorder.device().vk;
  const VkCommandBuffer commands = recorder.commands();
  const shared::Frame& frame = inputs.host_frame[view];
  const CellGrid pixels{.px = pass.raster.pixel};
  const VkRect2D area{.extent = {pixels.across(frame.size_px.x), pixels.across(frame.size_px.y)}};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1};
  const VkViewport viewport{.width = static_cast<float>(area.extent.width),
                            .height = static_cast<float>(area.extent.height),
                            .maxDepth = 1.0F};
  vk.vkCmdBeginRendering(commands, &rendering);
  vk.vkCmdSetViewport(commands, 0, 1, &viewport);
  vk.vkCmdSetScissor(commands, 0, 1, &area);
  const Extent& extent = pass.extent;
  if (extent.indirect != NO_RESOURCE) {
    const BufferPart counts = part(extent.indirect, view, inputs.slot);
    vk.vkCmdDrawIndirect(commands, counts.buffer, counts.offset + extent.indirect_offset, 1,
                         sizeof(VkDrawIndirectCommand));
  } else {
    const auto counts = counts_of(extent, frame);
    vk.vkCmdDraw(commands, extent.x, extent.lights_per_group == 0 ? extent.y : counts[0], 0, 0);
  }
  vk.vkCmdEndRendering(commands);
}

}  // namespace lamp::vulkan
