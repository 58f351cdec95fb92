// The Culler: a plan runner, a frame buffer, a read-back of counts; more room when a frame needed it.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/culler.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include "null_handles.h"

namespace lamp::vulkan {
namespace {

constexpr std::uint64_t FREE = 0;  // before every frame's number
constexpr std::uint64_t LIGHT_COUNT_BYTES = sizeof(shared::Frame::light_count);

/// What of a count on the GPU does not go together.
std::optional<Error> check_gpu_count(const CullerFrame& frame, const Plan& plan) {
  if (frame.light_count != 0)
    return Error{"light count",
                 "expected 0 beside a buffer that holds the count, got " + std::to_string(frame.light_count)};
  if (frame.light_count_offset % LIGHT_COUNT_BYTES != 0)
    return Error{"light count offset",
                 "expected a multiple of 4 bytes, got " + std::to_string(frame.light_count_offset)};
  const auto host = std::ranges::find(plan.passes, PassKind::host, &Pass::kind);
  if (host == plan.passes.end()) return std::nullopt;
  return Error{"light count buffer",
               "expected light_count, since option " + host->option + " works on the CPU, which knows no other"};
}

/// None where passes wait for a copy of the records anyway.
Result<Buffer> make_records(const Device& device, const CullerInfo& info) {
  if (!info.host_barriers) return Buffer();
  return Buffer::create(device, {.name = "frame records",
                                 .bytes = info.frames_in_flight * info.views * sizeof(shared::Frame),
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                 .memory = MemoryUse::records});
}

}  // namespace

Result<Culler> Culler::create(const Device& device, const CullerInfo& info) {
  if (auto error = check_made(device)) return *error;
  if (info.readers == 0) return Error{"readers", "expected the stages that read the look-up, got none"};
  const Result<const Method*> method = find_method(info.method);
  if (!method) return method.error();
  if (info.still.buffer != VK_NULL_HANDLE && !method.value()->still)
    return Error{"still lights",
                 "expected no buffer for method " + info.method + ", which reads none; world-tree does"};
  Result<Options> options = resolve_options(*method.value(), info.options);
  if (!options) return options.error();
  Culler culler;
  culler.device_ = device;
  culler.method_ = method.value();
  culler.problem_ = {.width = info.width,
                     .height = info.height,
                     .views = info.views,
                     .light_capacity = info.light_capacity,
                     .options = std::move(options.value()),
                     .traits = device.traits,
                     .light_layout = info.light_layout,
                     .own_spheres = !info.brings_spheres,
                     .depth_samples = info.depth_samples,
                     .frames_in_flight = info.frames_in_flight,
                     .smaller_frames = true};
  Result<Plan> plan = make_plan(*method.value(), culler.problem_);
  if (!plan) return plan.error();
  Result<PlanRunner> runner = PlanRunner::create(device, std::move(plan.value()));
  if (!runner) return runner.error();
  culler.runner_ = std::move(runner.value());
  Result<Buffer> frame = Buffer::create(
      device, {.name = "frame",
               .bytes = info.views * sizeof(shared::Frame),
               .usage = device.addressable(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                                           VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT)});
  if (!frame) return frame.error();
  Result<Buffer> records = make_records(device, info);
  if (!records) return records.error();
  Result<Buffer> counts = Buffer::create(device, {.name = "light counts read-back",
                                                  .bytes = info.frames_in_flight * LIGHT_COUNT_BYTES,
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                  .memory = MemoryUse::readback});
  if (!counts) return counts.error();
  culler.frame_ = std::move(frame.value());
  culler.records_ = std::move(records.value());
  culler.light_counts_ = std::move(counts.value());
  culler.readers_ = info.readers;
  culler.host_barriers_ = info.host_barriers;
  culler.still_ = info.still;
  culler.slots_.assign(info.frames_in_flight, FREE);
  culler.reserve();
  return culler;
}

/// For whatever a record touches.
void Culler::reserve() {
  tracker_.reserve(runner_.plan().buffers.size() + problem_.views + PLAN_BUFFER + 3, problem_.views);
}

Result<Culler::Views> Culler::views_of(const CullerFrame& frame) const {
  const CullerView only{frame.view, frame.depth_image, frame.depth_view, frame.depth_layout, frame.depth_offset};
  const std::span<const CullerView> views = frame.views.empty() ? std::span(&only, 1) : frame.views;
  if (views.size() != problem_.views)
    return Error{"views", "expected " + std::to_string(problem_.views) + ", as many as the Culler was made for, got " +
                              std::to_string(views.size())};
  // Of lights that the GPU counts, passes are dispatched for as many as there is room for; shaders stop at the count.
  const std::uint32_t capacity = problem_.light_capacity;
  const std::uint32_t lights = frame.light_count_buffer != VK_NULL_HANDLE ? capacity : frame.light_count;
  Views seen{};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const CullerView& view = views[i];
    if (view.view == nullptr) return Error{"view", "expected the frame's camera, got none"};
    seen.records[i] = view.view->frame(lights, capacity);
    seen.records[i].box_count = frame.box_count;
    seen.records[i].probe_count = frame.probe_count;
    if (view.depth_offset.x < 0 || view.depth_offset.y < 0)
      return Error{"depth offset", "expected where the picture begins in the depth image, got " +
                                       std::to_string(view.depth_offset.x) + ", " +
                                       std::to_string(view.depth_offset.y)};
    seen.records[i].view_index = static_cast<std::uint32_t>(i);
    seen.records[i].cell_shift = runner_.plan().cell_shift(view.view->width(), view.view->height());
    seen.records[i].depth_offset_px = {static_cast<std::uint32_t>(view.depth_offset.x),
                                       static_cast<std::uint32_t>(view.depth_offset.y)};
    seen.depths[i] = {.type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                      .image = view.depth_image,
                      .view = view.depth_view,
                      .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                      .layout = view.depth_layout};
  }
  return seen;
}

Result<std::uint64_t> Culler::record(VkCommandBuffer commands, const CullerFrame& frame) {
  if (slots_.empty()) return Error{"Culler", "expected one that Culler::create made, got an empty one"};
  const bool gpu_counts = frame.light_count_buffer != VK_NULL_HANDLE;
  if (gpu_counts)
    if (auto error = check_gpu_count(frame, runner_.plan())) return *error;
  const Result<Views> views = views_of(frame);
  if (!views) return views.error();
  const std::span<const Resource> depths = std::span(views.value().depths).first(problem_.views);
  PlanInputs inputs{.frame = frame_.handle(),
                    .lights = frame.lights,
                    .cones = frame.cones,
                    .spheres = frame.spheres,
                    .radial = frame.radial,
                    .meshes = frame.meshes,
                    .still = still_,
                    .depth = depths.front(),
                    .host_lights = frame.host_lights,
                    .host_frame = views.value().records.data()};
  if (problem_.views > 1) inputs.depths = depths;
  if (auto error = runner_.check(inputs)) return *error;
  if (commands == VK_NULL_HANDLE) return Error{"commands", "expected a command buffer, got null"};
  inputs.slot = last_slot_ = take_slot(++frames_);
  // Passes that wait for nothing of the Culler's own read records that the host has written; the look-up's follow them.
  const bool waits = !host_barriers_ || gpu_counts;
  if (!waits) inputs.frame = write_records(views.value());
  // It knows nothing of other frames, which may never run, and keeps nothing of the host's.
  tracker_.reset();
  for (const Resource& depth : depths)
    if (depth.image != VK_NULL_HANDLE) tracker_.assume(depth);
  for (const BufferPart& part :
       {inputs.lights, inputs.cones, inputs.spheres, inputs.radial, inputs.meshes, inputs.still})
    if (part.buffer != VK_NULL_HANDLE) tracker_.assume(Resource::storage(part));
  Recorder recorder(device_, commands, tracker_);
  if (!host_barriers_) recorder.order(barrier_before());
  if (waits) record_frame(recorder, views.value(), frame);
  if (const Result<std::uint64_t> recorded = runner_.record(recorder, inputs); !recorded) return recorded.error();
  if (!waits) record_frame(recorder, views.value(), frame);
  if (!host_barriers_) recorder.order(barrier_behind());
  if (gpu_counts) record_light_count(recorder);
  return frames_;
}

VkMemoryBarrier2 Culler::barrier_before() const {
  // Hosts order what they do with inputs against compute shaders; other stages of the passes hang on these.
  const VkPipelineStageFlags2 stages = runner_.stages() | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  return full_barrier(stages | readers_, stages);
}

VkMemoryBarrier2 Culler::barrier_behind() const {
  const VkPipelineStageFlags2 stages = runner_.stages() | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  return full_barrier(stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | readers_ | VK_PIPELINE_STAGE_2_HOST_BIT);
}

/// In the slot of the frame, whose last one is done.
BufferPart Culler::write_records(const Views& views) const {
  const std::size_t bytes = problem_.views * sizeof(shared::Frame);
  std::memcpy(records_.mapped().subspan(last_slot_ * bytes, bytes).data(), views.records.data(), bytes);
  return {records_.handle(), last_slot_ * bytes, bytes};
}

void Culler::record_frame(Recorder& recorder, const Views& views, const CullerFrame& frame) const {
  const Use written{.resource = Resource::storage(frame_.handle()),
                    .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    .access = VK_ACCESS_2_TRANSFER_WRITE_BIT};
  recorder.barrier({written});
  device_.vk.vkCmdUpdateBuffer(recorder.commands(), frame_.handle(), 0, problem_.views * sizeof(shared::Frame),
                               views.records.data());
  if (frame.light_count_buffer == VK_NULL_HANDLE) return;
  recorder.barrier({written});
  std::array<VkBufferCopy, MAX_VIEWS> counts{};
  for (std::uint32_t view = 0; view < problem_.views; ++view)
    counts[view] = {.srcOffset = frame.light_count_offset,
                    .dstOffset = view * sizeof(shared::Frame) + offsetof(shared::Frame, light_count),
                    .size = LIGHT_COUNT_BYTES};
  device_.vk.vkCmdCopyBuffer(recorder.commands(), frame.light_count_buffer, frame_.handle(), problem_.views,
                             counts.data());
}

/// The lights that there were, for the host.
void Culler::record_light_count(Recorder& recorder) const {
  const Resource to = Resource::storage(light_counts_.handle());
  recorder.barrier(
      {{.resource = Resource::storage(frame_.handle()),
        .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
        .access = VK_ACCESS_2_TRANSFER_READ_BIT},
       {.resource = to, .stages = VK_PIPELINE_STAGE_2_COPY_BIT, .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  const VkBufferCopy count{.srcOffset = offsetof(shared::Frame, light_count),
                           .dstOffset = last_slot_ * LIGHT_COUNT_BYTES,
                           .size = LIGHT_COUNT_BYTES};
  device_.vk.vkCmdCopyBuffer(recorder.commands(), frame_.handle(), light_counts_.handle(), 1, &count);
  recorder.barrier({{.resource = to, .stages = VK_PIPELINE_STAGE_2_HOST_BIT, .access = VK_ACCESS_2_HOST_READ_BIT}});
}

BoundLookUp Culler::lookup() const { return runner_.lookup({.frame = frame_.handle(), .still = still_}); }

std::optional<std::uint32_t> Culler::slot_of(std::uint64_t frame) const {
  const auto found = std::ranges::find(slots_, frame);
  if (found == slots_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - slots_.begin());
}

/// A free slot, or that of the frame that was recorded first: it is done. Begins with no lights.
std::uint32_t Culler::take_slot(std::uint64_t frame) {
  const auto slot = std::ranges::min_element(slots_);
  *slot = frame;
  const auto taken = static_cast<std::uint32_t>(slot - slots_.begin());
  std::ranges::fill(light_count_in(taken), std::byte{0});
  return taken;
}

std::span<std::byte> Culler::light_count_in(std::uint32_t slot) const {
  return light_counts_.mapped().subspan(slot * LIGHT_COUNT_BYTES, LIGHT_COUNT_BYTES);
}

/// From the runner that it was recorded with.
FrameCounts Culler::counts_of(std::uint64_t frame, std::uint32_t slot) const {
  const auto retired =
      std::ranges::find_if(retired_, [&](const Retired& runner) { return frame <= runner.last_frame; });
  FrameCounts counts = (retired != retired_.end() ? retired->runner : runner_).counts(slot);
  std::uint32_t lights = 0;  // unless the GPU counted them
  std::memcpy(&lights, light_count_in(slot).data(), LIGHT_COUNT_BYTES);
  counts.counters.excess_lights = lights - std::min(lights, problem_.light_capacity);
  return counts;
}

shared::Counters Culler::counters() const {
  if (frames_ == last_finished_) return finished_counters_;
  return counts_of(frames_, last_slot_).counters;
}

Result<Growth> Culler::finish(std::uint64_t frame) {
  const std::optional<std::uint32_t> slot = slot_of(frame);
  assert(frame != FREE && slot && "finish each frame once, before frames_in_flight further ones are recorded");
  FrameCounts counts;
  if (slot) {
    counts = counts_of(frame, *slot);
    slots_[*slot] = FREE;
    last_finished_ = frame;
    finished_counters_ = counts.counters;
  }
  std::erase_if(retired_, [&](const Retired& retired) { return retired.last_frame <= frame; });
  if (!slot || frame < first_frame_) return Growth::none;
  runner_.finish(frame - first_frame_ + 1);
  std::optional<GrownPlan> grown = grow_plan(*method_, problem_, runner_.plan(), counts.needed);
  return grown ? grow(std::move(*grown)) : Result<Growth>(Growth::none);
}

void Culler::drop(std::uint64_t frame) {
  const std::optional<std::uint32_t> slot = slot_of(frame);
  assert(frame != FREE && slot && "drop a frame instead of finishing it");
  if (slot) slots_[*slot] = FREE;
}

Result<Growth> Culler::grow(GrownPlan grown) {
  const LookUp before = runner_.plan().lookup;
  Result<PlanRunner> runner = PlanRunner::create(device_, std::move(grown.plan));
  if (!runner) return runner.error();
  retired_.push_back({std::exchange(runner_, std::move(runner.value())), frames_});
  problem_.options = std::move(grown.options);
  first_frame_ = frames_ + 1;
  reserve();
  const LookUp& now = runner_.plan().lookup;
  const bool same = now.constants == before.constants && now.view_words == before.view_words;
  return same ? Growth::buffers : Growth::constants;
}

}  // namespace lamp::vulkan
