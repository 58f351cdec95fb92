// Allocates a plan's buffers, builds its pipelines, records its passes.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/plan_runner.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <span>

#include "lamplight/shared/world_tree.h"
#include "null_handles.h"
#include "pass_use.h"

namespace lamp::vulkan {
namespace {

BufferInfo buffer_info(const Device& device, const Plan& plan, const BufferDesc& desc) {
  VkBufferUsageFlags usage =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  if (desc.indirect) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  const bool is_counts = desc.memory == BufferMemory::counts;
  return {.name = desc.name,
          .bytes = is_counts ? plan.bytes_of(desc) : plan.all_bytes(desc),
          .usage = is_counts ? usage : device.addressable(usage),
          .memory = is_counts ? MemoryUse::counts : MemoryUse::device};
}

/// What a buffer of upload memory is filled from; none for others.
Result<Buffer> make_slots(const Device& device, const Plan& plan, const BufferDesc& desc) {
  if (desc.memory != BufferMemory::upload) return Buffer();
  return Buffer::create(device, {.name = desc.name + " slots",
                                 .bytes = plan.all_bytes(desc) * plan.frames_in_flight,
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

/// Whose look-up walks every light.
Result<Buffer> tree_of_every_light(const Device& device) {
  Result<Buffer> buffer = Buffer::create(device, {.name = "every light",
                                                  .bytes = shared::TREE_HEADER * sizeof(std::uint32_t),
                                                  .usage = device.addressable(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
                                                  .memory = MemoryUse::upload});
  if (!buffer) return buffer;
  std::array<std::uint32_t, shared::TREE_HEADER> words{};
  words[shared::TREE_ROOT] = words[shared::TREE_OUTSIDE] = shared::TREE_ALL << shared::TREE_KIND_BIT;
  std::ranges::copy(std::as_bytes(std::span(words)), buffer.value().mapped().begin());
  return buffer;
}

}  // namespace

Result<PlanRunner::Sequence> PlanRunner::build(const Device& device, const std::vector<Pass>& passes,
                                               const ShaderSource& shaders) {
  Sequence sequence;
  for (const Pass& pass : passes) {
    BuiltPass& built = sequence.passes.emplace_back(BuiltPass{.pass = pass});
    if (auto error = add_size(device, built, pass, 0, shaders)) return *error;
    if (auto error = make_sets(device, built)) return *error;
  }
  bind_all(sequence);
  return sequence;
}

std::optional<Error> PlanRunner::add_size(const Device& device, BuiltPass& built, const Pass& pass, std::uint32_t shift,
                                          const ShaderSource& shaders) {
  Result<Pipeline> pipeline = make_pipeline(device, pass, shaders);
  if (!pipeline) return pipeline.error();
  built.sizes.push_back({.shift = shift, .extent = pass.extent, .pipeline = std::move(pipeline.value())});
  return std::nullopt;
}

/// Descriptor sets go with the pipelines of any size: their layouts are the same.
std::optional<Error> PlanRunner::build_finer(const Device& device, const ShaderSource& shaders) {
  for (const FinerPasses& finer : plan_.finer)
    for (std::size_t i = 0; i < finer.passes.size(); ++i)
      if (auto error = add_size(device, separate_.passes[i], finer.passes[i], finer.shift, shaders)) return error;
  return std::nullopt;
}

const PlanRunner::BuiltPass::Sized& PlanRunner::BuiltPass::of_shift(std::uint32_t shift) const {
  const auto found = std::ranges::find(sizes, shift, &Sized::shift);
  return found == sizes.end() ? sizes.front() : *found;
}

std::optional<Error> PlanRunner::make_sets(const Device& device, BuiltPass& built) {
  if (device.pushes_descriptors() || built.pass.kind == PassKind::host) return std::nullopt;
  for (std::uint32_t i = 0; i < plan_.frames_in_flight * plan_.views; ++i) {
    const Result<VkDescriptorSet> set = sets_.allocate(built.sizes.front().pipeline);
    if (!set) return set.error();
    built.sets.push_back(set.value());
  }
  return std::nullopt;
}

VkDescriptorSet PlanRunner::set(const BuiltPass& built, std::uint32_t slot, std::uint32_t view) const {
  return built.sets.empty() ? VK_NULL_HANDLE : built.sets[slot * plan_.views + view];
}

Result<PlanRunner> PlanRunner::create(const Device& device, Plan plan, const ShaderSource& shaders) {
  if (auto error = check_made(device)) return *error;
  PlanRunner runner;
  runner.plan_ = std::move(plan);
  runner.sets_ = DescriptorSets(device);
  runner.offset_alignment_ = device.traits.storage_offset_alignment;
  runner.addressable_ = device.buffer_addresses;
  for (const BufferDesc& desc : runner.plan_.buffers) {
    Result<Buffer> buffer = Buffer::create(device, buffer_info(device, runner.plan_, desc));
    if (!buffer) return buffer.error();
    std::ranges::fill(buffer.value().mapped(), std::byte{0});
    runner.buffers_.push_back(std::move(buffer.value()));
    Result<Buffer> slots = make_slots(device, runner.plan_, desc);
    if (!slots) return slots.error();
    runner.slots_.push_back(std::move(slots.value()));
  }
  if (runner.plan_.binds(INPUT_DEPTH)) {
    Result<OwnedSampler> sampler = depth_sampler(device);
    if (!sampler) return sampler.error();
    runner.depth_sampler_ = std::move(sampler.value());
  }
  if (runner.plan_.binds(INPUT_STILL)) {
    Result<Buffer> every_light = tree_of_every_light(device);
    if (!every_light) return every_light.error();
    runner.every_light_ = std::move(every_light.value());
  }
  auto separate = runner.build(device, runner.plan_.passes, shaders);
  if (!separate) return separate.error();
  runner.separate_ = std::move(separate.value());
  if (auto error = runner.build_finer(device, shaders)) return *error;
  if (runner.plan_.fused) {
    auto fused = runner.build(device, runner.plan_.fused->passes, shaders);
    if (!fused) return fused.error();
    runner.fused_ = std::move(fused.value());
  }
  runner.reserve();
  return runner;
}

/// For the largest record.
void PlanRunner::reserve() {
  std::size_t uses = plan_.buffers.size() + plan_.capacities.size() + 2;
  std::size_t host_passes = 0;
  for (const Sequence* sequence : {&separate_, &fused_}) {
    std::size_t all = 0;
    for (const BoundPass& bound : sequence->bound) all += bound.uses.size();
    uses = std::max(uses, all);
    for (const BuiltPass& built : sequence->passes) {
      if (built.pass.kind != PassKind::host) continue;
      ++host_passes;
      mapped_.reserve(std::max(mapped_.capacity(), built.pass.bindings.size()));
    }
  }
  uses_.reserve(uses);
  written_.reserve(plan_.buffers.size());
  host_times_.reserve(host_passes * plan_.views);
}

std::span<const PipelineStatistic> PlanRunner::statistics(std::string_view pass) const {
  for (const Sequence* sequence : {&separate_, &fused_})
    for (const BuiltPass& built : sequence->passes)
      if (built.pass.name == pass) return built.sizes.front().pipeline.statistics();
  return {};
}

VkBuffer PlanRunner::buffer(ResourceId id) const {
  return id < PLAN_BUFFER || id - PLAN_BUFFER >= buffers_.size() ? VK_NULL_HANDLE : buffers_[id - PLAN_BUFFER].handle();
}

Result<std::uint64_t> PlanRunner::record(Recorder& recorder, const PlanInputs& inputs, Passes which) {
  if (auto error = check(inputs)) return *error;
  Sequence& sequence = which == Passes::fused ? fused_ : separate_;
  std::ranges::fill(count_bytes(inputs.slot), std::byte{0});  // of a frame that is dropped
  bind_inputs(sequence, inputs);
  record_host_passes(recorder, sequence, inputs);
  zero_buffers(recorder, inputs);
  ++records_;
  for (const Range& range : sequence.together) record_together(recorder, sequence, range, inputs);
  return records_;
}

bool PlanRunner::is_kept(std::uint32_t view, const shared::Frame& frame, std::uint64_t record) {
  std::optional<Kept>& kept = kept_[view];
  if (!kept || kept->projection != frame.clip_from_view || kept->size_px != frame.size_px)
    kept = Kept{.projection = frame.clip_from_view, .size_px = frame.size_px, .first_record = record};
  return kept->has_run;
}

void PlanRunner::finish(std::uint64_t record) {
  assert(record >= 1 && record <= records_ && "finish what was recorded");
  for (std::optional<Kept>& kept : kept_)
    if (kept && record >= kept->first_record) kept->has_run = true;
}

VkPipelineStageFlags2 PlanRunner::stages() const {
  VkPipelineStageFlags2 all = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  for (const Sequence* sequence : {&separate_, &fused_})
    for (const BuiltPass& built : sequence->passes) {
      all |= shader_stages(built.pass);
      if (built.pass.extent.indirect != NO_RESOURCE) all |= VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
    }
  return all;
}

void PlanRunner::record_host_passes(Recorder& recorder, const Sequence& sequence, const PlanInputs& inputs) {
  host_times_.clear();
  written_.clear();
  for (const BuiltPass& built : sequence.passes) {
    if (built.pass.kind != PassKind::host) continue;
    for (std::uint32_t view = 0; view < plan_.views; ++view) run_on_host(built.pass, inputs, view);
    for (const Binding& binding : built.pass.bindings)
      if (binding.access != Access::read && std::ranges::find(written_, binding.resource) == written_.end())
        written_.push_back(binding.resource);
  }
  if (!written_.empty()) upload(recorder, inputs.slot);
}

void PlanRunner::run_on_host(const Pass& pass, const PlanInputs& inputs, std::uint32_t view) {
  mapped_.clear();
  for (const Binding& binding : pass.bindings) {
    const std::size_t i = binding.resource - PLAN_BUFFER;
    const BufferDesc& desc = plan_.buffers[i];
    const std::uint64_t begin = inputs.slot * plan_.all_bytes(desc) + view * plan_.view_bytes(desc);
    mapped_.push_back(slots_[i].mapped().subspan(begin, desc.bytes));
  }
  const shared::Frame& frame = inputs.host_frame[view];
  const auto begin = std::chrono::steady_clock::now();
  pass.host({.lights = inputs.host_lights.first(frame.light_count),
             .frame = &frame,
             .buffers = mapped_,
             .constants = pass.constants});
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  host_times_.push_back({pass.name, taken.count()});
}

void PlanRunner::upload(Recorder& recorder, std::uint32_t slot) {
  uses_.clear();
  for (const ResourceId id : written_)
    uses_.push_back({.resource = Resource::storage(buffer(id)),
                     .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                     .access = VK_ACCESS_2_TRANSFER_WRITE_BIT});
  recorder.begin_pass(UPLOAD_PASS, uses_);
  for (const ResourceId id : written_) {
    const std::uint64_t bytes = buffers_[id - PLAN_BUFFER].bytes();
    const VkBufferCopy of_slot{.srcOffset = slot * bytes, .size = bytes};
    recorder.device().vk.vkCmdCopyBuffer(recorder.commands(), slots_[id - PLAN_BUFFER].handle(), buffer(id), 1,
                                         &of_slot);
  }
  recorder.end_pass();
}

}  // namespace lamp::vulkan
