// Allocates a plan's buffers, builds its pipelines, records its passes.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/plan_runner.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>

#include "pass_use.h"

namespace lamp::vulkan {
namespace {

BufferInfo buffer_info(const BufferDesc& desc) {
  VkBufferUsageFlags usage =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  if (desc.indirect) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  return {.name = desc.name, .bytes = desc.bytes, .usage = usage};
}

/// What a buffer of upload memory is filled from; none for others.
Result<Buffer> make_slots(const Device& device, const BufferDesc& desc, std::uint32_t frames_in_flight) {
  if (desc.memory != BufferMemory::upload) return Buffer();
  return Buffer::create(device, {.name = desc.name + " slots",
                                 .bytes = desc.bytes * frames_in_flight,
                                 .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                 .memory = MemoryUse::upload});
}

/// Of the depth image, whose shaders may gather four pixels at once, and leave out what lies beyond the picture.
Result<OwnedSampler> depth_sampler(const Device& device) {
  const VkSamplerCreateInfo create{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
  VkSampler sampler = VK_NULL_HANDLE;
  if (const VkResult r = device.vk.vkCreateSampler(device.handle, &create, nullptr, &sampler); r != VK_SUCCESS)
    return Error{"sampler of the depth image", result_text(r)};
  return OwnedSampler(device.handle, sampler, device.vk.vkDestroySampler);
}

std::array<std::uint32_t, 3> counts_of(const Extent& extent, const shared::Frame& frame) {
  const auto counts = extent.counts(frame.size_px.x, frame.size_px.y, frame.light_count);
  return {static_cast<std::uint32_t>(counts[0]), static_cast<std::uint32_t>(counts[1]),
          static_cast<std::uint32_t>(counts[2])};
}

/// Of a buffer that is zeroed, what the frame's picture takes of it.
std::uint64_t zeroed_bytes(const BufferDesc& desc, const shared::Frame& frame) {
  if (desc.zeroed_cells.px == 0) return desc.bytes;
  return desc.zeroed_cells.count(frame.size_px.x, frame.size_px.y) * desc.cell_bytes;
}

}  // namespace

Result<std::vector<PlanRunner::BuiltPass>> PlanRunner::build(const Device& device, const std::vector<Pass>& passes,
                                                             const ShaderSource& shaders) {
  std::vector<BuiltPass> built;
  for (const Pass& pass : passes) {
    Result<Pipeline> pipeline = make_pipeline(device, pass, shaders);
    if (!pipeline) return pipeline.error();
    built.push_back({.pass = pass, .pipeline = std::move(pipeline.value())});
    if (auto error = make_sets(device, built.back())) return *error;
  }
  return built;
}

std::optional<Error> PlanRunner::make_sets(const Device& device, BuiltPass& built) {
  if (device.pushes_descriptors() || built.pass.kind == PassKind::host) return std::nullopt;
  for (std::uint32_t slot = 0; slot < plan_.frames_in_flight; ++slot) {
    const Result<VkDescriptorSet> set = sets_.allocate(built.pipeline);
    if (!set) return set.error();
    built.sets.push_back(set.value());
  }
  return std::nullopt;
}

Result<PlanRunner> PlanRunner::create(const Device& device, Plan plan, const ShaderSource& shaders) {
  PlanRunner runner;
  runner.plan_ = std::move(plan);
  runner.sets_ = DescriptorSets(device);
  runner.offset_alignment_ = device.traits.storage_offset_alignment;
  for (const BufferDesc& desc : runner.plan_.buffers) {
    Result<Buffer> buffer = Buffer::create(device, buffer_info(desc));
    if (!buffer) return buffer.error();
    runner.buffers_.push_back(std::move(buffer.value()));
    Result<Buffer> slots = make_slots(device, desc, runner.plan_.frames_in_flight);
    if (!slots) return slots.error();
    runner.slots_.push_back(std::move(slots.value()));
  }
  if (runner.plan_.binds(INPUT_DEPTH)) {
    Result<OwnedSampler> sampler = depth_sampler(device);
    if (!sampler) return sampler.error();
    runner.depth_sampler_ = std::move(sampler.value());
  }
  auto separate = runner.build(device, runner.plan_.passes, shaders);
  if (!separate) return separate.error();
  runner.separate_ = std::move(separate.value());
  if (runner.plan_.fused) {
    auto fused = runner.build(device, runner.plan_.fused->passes, shaders);
    if (!fused) return fused.error();
    runner.fused_ = std::move(fused.value());
  }
  return runner;
}

std::span<const PipelineStatistic> PlanRunner::statistics(std::string_view pass) const {
  for (const auto* passes : {&separate_, &fused_})
    for (const BuiltPass& built : *passes)
      if (built.pass.name == pass) return built.pipeline.statistics();
  return {};
}

VkBuffer PlanRunner::buffer(ResourceId id) const {
  return id < PLAN_BUFFER || id == NO_RESOURCE ? VK_NULL_HANDLE : buffers_[id - PLAN_BUFFER].handle();
}

Result<std::uint64_t> PlanRunner::record(Recorder& recorder, const PlanInputs& inputs, Passes which) {
  if (auto error = check(inputs)) return *error;
  const std::vector<BuiltPass>& passes = which == Passes::fused ? fused_ : separate_;
  record_host_passes(recorder, passes, inputs);
  zero_buffers(recorder, *inputs.host_frame);
  const bool kept = is_kept(*inputs.host_frame, ++records_);
  std::vector<BoundPass> together;
  for (const BuiltPass& built : passes) {
    if (built.pass.kind == PassKind::host) continue;
    if (built.pass.on_projection_change) {
      if (kept) continue;
      ++projection_rebuilds_;
    }
    BoundPass next = bind(built, inputs);
    if (std::ranges::any_of(together, [&](const BoundPass& one) { return depends(next, one); })) {
      record_together(recorder, together, inputs);
      together.clear();
    }
    together.push_back(std::move(next));
  }
  record_together(recorder, together, inputs);
  return records_;
}

void PlanRunner::record_counts(Recorder& recorder, const Buffer& to, std::uint64_t offset) const {
  if (plan_.counters == NO_RESOURCE) return;
  struct Source {
    VkBuffer buffer;
    VkBufferCopy copy;
  };
  std::vector<Source> sources{{buffer(plan_.counters), {.dstOffset = offset, .size = sizeof(shared::Counters)}}};
  for (const Capacity& capacity : plan_.capacities) {
    const VkBufferCopy& last = sources.back().copy;
    sources.push_back({buffer(capacity.needed),
                       {.srcOffset = capacity.needed_offset,
                        .dstOffset = last.dstOffset + last.size,
                        .size = sizeof(std::uint32_t)}});
  }
  std::vector<Use> uses{{.resource = Resource::storage(to.handle()),
                         .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                         .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}};
  for (const Source& source : sources)
    uses.push_back({.resource = Resource::storage(source.buffer),
                    .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                    .access = VK_ACCESS_2_TRANSFER_READ_BIT});
  recorder.barrier(uses);
  for (const Source& source : sources)
    recorder.device().vk.vkCmdCopyBuffer(recorder.commands(), source.buffer, to.handle(), 1, &source.copy);
  recorder.barrier({{.resource = Resource::storage(to.handle()),
                     .stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                     .access = VK_ACCESS_2_HOST_READ_BIT}});
}

bool PlanRunner::is_kept(const shared::Frame& frame, std::uint64_t record) {
  if (!kept_ || kept_->projection != frame.clip_from_view || kept_->size_px != frame.size_px)
    kept_ = Kept{.projection = frame.clip_from_view, .size_px = frame.size_px, .first_record = record};
  return kept_->has_run;
}

void PlanRunner::finish(std::uint64_t record) {
  assert(record >= 1 && record <= records_ && "finish what was recorded");
  if (kept_ && record >= kept_->first_record) kept_->has_run = true;
}

VkPipelineStageFlags2 PlanRunner::stages() const {
  VkPipelineStageFlags2 all = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  for (const auto* passes : {&separate_, &fused_})
    for (const BuiltPass& built : *passes) {
      all |= shader_stages(built.pass);
      if (built.pass.extent.indirect != NO_RESOURCE) all |= VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
    }
  return all;
}

void PlanRunner::zero_buffers(Recorder& recorder, const shared::Frame& frame) const {
  std::vector<Use> uses;
  for (std::size_t i = 0; i < buffers_.size(); ++i)
    if (plan_.buffers[i].zeroed)
      uses.push_back({.resource = Resource::storage(buffers_[i].handle()),
                      .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                      .access = VK_ACCESS_2_TRANSFER_WRITE_BIT});
  if (uses.empty()) return;
  recorder.begin_pass(CLEAR_PASS, uses);
  for (std::size_t i = 0; i < buffers_.size(); ++i)
    if (plan_.buffers[i].zeroed)
      recorder.device().vk.vkCmdFillBuffer(recorder.commands(), buffers_[i].handle(), 0,
                                           zeroed_bytes(plan_.buffers[i], frame), 0);
  recorder.end_pass();
}

void PlanRunner::record_host_passes(Recorder& recorder, const std::vector<BuiltPass>& passes,
                                    const PlanInputs& inputs) {
  host_times_.clear();
  std::vector<ResourceId> written;
  for (const BuiltPass& built : passes) {
    if (built.pass.kind != PassKind::host) continue;
    run_on_host(built.pass, inputs);
    for (const Binding& binding : built.pass.bindings)
      if (binding.access != Access::read && std::ranges::find(written, binding.resource) == written.end())
        written.push_back(binding.resource);
  }
  if (!written.empty()) upload(recorder, written, inputs.slot);
}

void PlanRunner::run_on_host(const Pass& pass, const PlanInputs& inputs) {
  std::vector<std::span<std::byte>> mapped;
  for (const Binding& binding : pass.bindings) {
    const std::size_t i = binding.resource - PLAN_BUFFER;
    mapped.push_back(slots_[i].mapped().subspan(inputs.slot * buffers_[i].bytes(), buffers_[i].bytes()));
  }
  const auto lights = inputs.host_lights.first(inputs.host_frame->light_count);
  const auto begin = std::chrono::steady_clock::now();
  pass.host({.lights = lights, .frame = inputs.host_frame, .buffers = mapped, .constants = pass.constants});
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  host_times_.push_back({pass.name, taken.count()});
}

void PlanRunner::upload(Recorder& recorder, std::span<const ResourceId> written, std::uint32_t slot) const {
  std::vector<Use> uses;
  for (const ResourceId id : written)
    uses.push_back({.resource = Resource::storage(buffer(id)),
                    .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                    .access = VK_ACCESS_2_TRANSFER_WRITE_BIT});
  recorder.begin_pass(UPLOAD_PASS, uses);
  for (const ResourceId id : written) {
    const std::uint64_t bytes = buffers_[id - PLAN_BUFFER].bytes();
    const VkBufferCopy of_slot{.srcOffset = slot * bytes, .size = bytes};
    recorder.device().vk.vkCmdCopyBuffer(recorder.commands(), slots_[id - PLAN_BUFFER].handle(), buffer(id), 1,
                                         &of_slot);
  }
  recorder.end_pass();
}

PlanRunner::BoundPass PlanRunner::bind(const BuiltPass& built, const PlanInputs& inputs) const {
  const Pass& pass = built.pass;
  BoundPass bound{.built = &built};
  for (std::uint32_t i = 0; i < pass.bindings.size(); ++i) {
    Resource used = resource(pass.bindings[i].resource, inputs);
    used.type = descriptor_type(pass.bindings[i].resource, pass);
    bound.uses.push_back(use_of(used, pass.bindings[i].access, shader_stages(pass)));
    bound.resources.push_back({i, used});
  }
  if (pass.extent.indirect != NO_RESOURCE)
    bound.uses.push_back({.resource = resource(pass.extent.indirect, inputs),
                          .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                          .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT});
  return bound;
}

bool PlanRunner::depends(const BoundPass& later, const BoundPass& earlier) {
  const auto writes = [](const Use& use) { return (use.access & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT) != 0; };
  return std::ranges::any_of(later.uses, [&](const Use& use) {
    return std::ranges::any_of(earlier.uses, [&](const Use& other) {
      return use.resource.buffer == other.resource.buffer && use.resource.image == other.resource.image &&
             (writes(use) || writes(other));
    });
  });
}

void PlanRunner::record_together(Recorder& recorder, std::span<const BoundPass> passes,
                                 const PlanInputs& inputs) const {
  std::vector<Use> uses;  // before the first of them, so that no barrier keeps them apart
  for (const BoundPass& bound : passes) uses.insert(uses.end(), bound.uses.begin(), bound.uses.end());
  for (const BoundPass& bound : passes) {
    const Pass& pass = bound.built->pass;
    recorder.begin_pass(pass.name, uses);
    uses.clear();
    recorder.bind(bound.built->pipeline, bound.resources, bound.built->set(inputs.slot));
    if (pass.kind == PassKind::raster)
      draw(recorder, pass, inputs);
    else
      dispatch(recorder, pass, inputs);
    recorder.end_pass();
  }
}

void PlanRunner::dispatch(const Recorder& recorder, const Pass& pass, const PlanInputs& inputs) const {
  const DeviceFunctions& vk = recorder.device().vk;
  const VkCommandBuffer commands = recorder.commands();
  const Extent& extent = pass.extent;
  if (extent.indirect != NO_RESOURCE)
    return vk.vkCmdDispatchIndirect(commands, buffer(extent.indirect), extent.indirect_offset);
  const auto [x, y, z] = counts_of(extent, *inputs.host_frame);
  if (x != 0) vk.vkCmdDispatch(commands, x, y, z);
}

void PlanRunner::draw(const Recorder& recorder, const Pass& pass, const PlanInputs& inputs) const {
  const DeviceFunctions& vk = recorder.device().vk;
  const VkCommandBuffer commands = recorder.commands();
  const CellGrid pixels{.px = pass.raster.pixel};
  const glm::uvec2 size_px = inputs.host_frame->size_px;
  const VkRect2D area{.extent = {pixels.across(size_px.x), pixels.across(size_px.y)}};
  const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1};
  const VkViewport viewport{.width = static_cast<float>(area.extent.width),
                            .height = static_cast<float>(area.extent.height),
                            .maxDepth = 1.0F};
  vk.vkCmdBeginRendering(commands, &rendering);
  vk.vkCmdSetViewport(commands, 0, 1, &viewport);
  vk.vkCmdSetScissor(commands, 0, 1, &area);
  const Extent& extent = pass.extent;
  if (extent.indirect != NO_RESOURCE) {
    vk.vkCmdDrawIndirect(commands, buffer(extent.indirect), extent.indirect_offset, 1, sizeof(VkDrawIndirectCommand));
  } else {
    const auto counts = counts_of(extent, *inputs.host_frame);
    vk.vkCmdDraw(commands, extent.x, extent.lights_per_group == 0 ? extent.y : counts[0], 0, 0);
  }
  vk.vkCmdEndRendering(commands);
}

}  // namespace lamp::vulkan
