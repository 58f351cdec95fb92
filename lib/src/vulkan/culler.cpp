// The Culler: a plan runner, a frame buffer, a read-back of counts; more room when a frame needed it.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/culler.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace lamp::vulkan {
namespace {

constexpr std::uint64_t FREE = 0;  // before every frame's number

}  // namespace

Result<Culler> Culler::create(const Device& device, const CullerInfo& info) {
  if (info.readers == 0) return Error{"readers", "expected the stages that read the look-up, got none"};
  const Result<const Method*> method = find_method(info.method);
  if (!method) return method.error();
  Result<Options> options = resolve_options(*method.value(), info.options);
  if (!options) return options.error();
  Culler culler;
  culler.device_ = device;
  culler.method_ = method.value();
  culler.problem_ = {.width = info.width,
                     .height = info.height,
                     .light_capacity = info.light_capacity,
                     .options = std::move(options.value()),
                     .traits = device.traits,
                     .own_spheres = !info.brings_spheres,
                     .frames_in_flight = info.frames_in_flight};
  Result<Plan> plan = make_plan(*method.value(), culler.problem_);
  if (!plan) return plan.error();
  const std::uint64_t slots_bytes = info.frames_in_flight * count_bytes(plan.value());
  Result<PlanRunner> runner = PlanRunner::create(device, std::move(plan.value()));
  if (!runner) return runner.error();
  Result<Buffer> frame =
      Buffer::create(device, {.name = "frame",
                              .bytes = sizeof(shared::Frame),
                              .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_DST_BIT});
  if (!frame) return frame.error();
  Result<Buffer> counts = Buffer::create(device, {.name = "counts read-back",
                                                  .bytes = slots_bytes,
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                  .memory = MemoryUse::readback});
  if (!counts) return counts.error();
  std::memset(counts.value().mapped().data(), 0, slots_bytes);
  culler.frame_ = std::move(frame.value());
  culler.counts_ = std::move(counts.value());
  culler.runner_ = std::move(runner.value());
  culler.readers_ = info.readers;
  culler.slots_.assign(info.frames_in_flight, FREE);
  return culler;
}

Result<std::uint64_t> Culler::record(VkCommandBuffer commands, const CullerFrame& frame) {
  if (frame.view == nullptr) return Error{"view", "expected the frame's camera, got none"};
  const shared::Frame record = frame.view->frame(frame.light_count, problem_.light_capacity);
  PlanInputs inputs{.frame = frame_.handle(),
                    .lights = frame.lights,
                    .spheres = frame.spheres,
                    .depth = {.type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                              .image = frame.depth_image,
                              .view = frame.depth_view,
                              .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                              .layout = frame.depth_layout},
                    .host_lights = frame.host_lights,
                    .host_frame = &record};
  if (auto error = runner_.check(inputs)) return *error;
  inputs.slot = last_slot_ = take_slot(++frames_);
  // A tracker of this frame alone: it knows nothing of others, which may never run, and keeps nothing of the host's.
  AccessTracker tracker;
  tracker.assume(inputs.depth);
  tracker.assume(Resource::storage(inputs.lights));
  if (inputs.spheres != VK_NULL_HANDLE) tracker.assume(Resource::storage(inputs.spheres));
  Recorder recorder(device_, commands, tracker);
  // Hosts order what they do with inputs against compute shaders; other stages of the passes hang on these.
  const VkPipelineStageFlags2 stages = runner_.stages() | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  recorder.order(stages | readers_, stages);
  recorder.barrier({{.resource = Resource::storage(frame_.handle()),
                     .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                     .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  device_.vk.vkCmdUpdateBuffer(commands, frame_.handle(), 0, sizeof(record), &record);
  if (const Result<std::uint64_t> recorded = runner_.record(recorder, inputs); !recorded) return recorded.error();
  recorder.order(stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | readers_);
  runner_.record_counts(recorder, counts_, last_slot_ * count_bytes(runner_.plan()));
  return frames_;
}

BoundLookUp Culler::lookup() const { return runner_.lookup({.frame = frame_.handle()}); }

std::optional<std::uint32_t> Culler::slot_of(std::uint64_t frame) const {
  const auto found = std::ranges::find(slots_, frame);
  if (found == slots_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - slots_.begin());
}

/// A free slot, or that of the frame that was recorded first: it is done. Begins with counts of zero.
std::uint32_t Culler::take_slot(std::uint64_t frame) {
  const auto slot = std::ranges::min_element(slots_);
  *slot = frame;
  const auto taken = static_cast<std::uint32_t>(slot - slots_.begin());
  std::ranges::fill(count_bytes_in(taken), std::byte{0});
  return taken;
}

std::span<std::byte> Culler::count_bytes_in(std::uint32_t slot) const {
  const std::uint64_t bytes = count_bytes(runner_.plan());
  return counts_.mapped().subspan(slot * bytes, bytes);
}

FrameCounts Culler::counts_in(std::uint32_t slot) const { return read_counts(runner_.plan(), count_bytes_in(slot)); }

Result<Growth> Culler::finish(std::uint64_t frame) {
  const std::optional<std::uint32_t> slot = slot_of(frame);
  assert(frame != FREE && slot && "finish each frame once, before frames_in_flight further ones are recorded");
  std::erase_if(retired_, [&](const Retired& retired) { return retired.last_frame <= frame; });
  if (!slot) return Growth::none;
  slots_[*slot] = FREE;
  if (frame < first_frame_) return Growth::none;
  runner_.finish(frame - first_frame_ + 1);
  if (runner_.plan().counters == NO_RESOURCE) return Growth::none;
  std::optional<GrownPlan> grown = grow_plan(*method_, problem_, runner_.plan(), counts_in(*slot).needed);
  return grown ? grow(std::move(*grown)) : Result<Growth>(Growth::none);
}

void Culler::drop(std::uint64_t frame) {
  const std::optional<std::uint32_t> slot = slot_of(frame);
  assert(frame != FREE && slot && "drop a frame instead of finishing it");
  if (slot) slots_[*slot] = FREE;
}

Result<Growth> Culler::grow(GrownPlan grown) {
  const std::vector<std::uint32_t> constants = runner_.plan().lookup.constants;
  Result<PlanRunner> runner = PlanRunner::create(device_, std::move(grown.plan));
  if (!runner) return runner.error();
  retired_.push_back({std::exchange(runner_, std::move(runner.value())), frames_});
  problem_.options = std::move(grown.options);
  first_frame_ = frames_ + 1;
  return runner_.plan().lookup.constants == constants ? Growth::buffers : Growth::constants;
}

}  // namespace lamp::vulkan
