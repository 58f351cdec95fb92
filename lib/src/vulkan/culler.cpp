// The Culler: a plan runner, a frame buffer, a read-back of counts; more room when a frame needed it.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/culler.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

namespace lamp::vulkan {
namespace {

constexpr const char* SPHERE_SHADER = "methods/light_spheres";
constexpr std::uint32_t SPHERE_THREADS = 64;  // of its work group

Result<Pipeline> sphere_pipeline(const Device& device) {
  const auto shader = embedded_shaders(SPHERE_SHADER);
  if (!shader) return shader.error();
  PipelineInfo info{.name = SPHERE_SHADER};
  for (std::uint32_t i = 0; i < 3; ++i) info.bindings.push_back({i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  return Pipeline::compute(device, info, shader.value());
}

Result<Buffer> sphere_buffer(const Device& device, std::uint64_t lights) {
  return Buffer::create(device, {.name = "light spheres",
                                 .bytes = std::max<std::uint64_t>(1, lights) * sizeof(shared::LightSphere),
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
}

}  // namespace

Result<Culler> Culler::create(const Device& device, const CullerInfo& info) {
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
                     .traits = device.traits};
  Result<Plan> plan = make_plan(*method.value(), culler.problem_);
  if (!plan) return plan.error();
  const std::uint64_t slots_bytes = FRAMES_IN_FLIGHT * count_bytes(plan.value());
  Result<PlanRunner> runner = PlanRunner::create(device, std::move(plan.value()));
  if (!runner) return runner.error();
  Result<Buffer> frame =
      Buffer::create(device, {.name = "frame",
                              .bytes = sizeof(shared::Frame),
                              .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
  if (!frame) return frame.error();
  Result<Buffer> counts = Buffer::create(device, {.name = "counts read-back",
                                                  .bytes = slots_bytes,
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                  .memory = MemoryUse::readback});
  if (!counts) return counts.error();
  std::memset(counts.value().mapped().data(), 0, slots_bytes);
  if (!info.brings_spheres) {
    Result<Buffer> spheres = sphere_buffer(device, info.light_capacity);
    if (!spheres) return spheres.error();
    Result<Pipeline> pipeline = sphere_pipeline(device);
    if (!pipeline) return pipeline.error();
    culler.spheres_ = std::move(spheres.value());
    culler.sphere_pipeline_ = std::move(pipeline.value());
  }
  culler.frame_ = std::move(frame.value());
  culler.counts_ = std::move(counts.value());
  culler.runner_ = std::move(runner.value());
  return culler;
}

std::uint64_t Culler::record(VkCommandBuffer commands, const CullerFrame& frame) {
  ++frames_;
  assert(frame.view != nullptr && "set CullerFrame::view");
  const bool makes_spheres = spheres_.handle() != VK_NULL_HANDLE;
  assert((makes_spheres || frame.spheres != VK_NULL_HANDLE) && "set CullerFrame::spheres");
  const shared::Frame record = frame.view->frame(frame.light_count);
  const PlanInputs inputs{.frame = frame_.handle(),
                          .lights = frame.lights,
                          .spheres = makes_spheres ? spheres_.handle() : frame.spheres,
                          .depth = {.type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                    .image = frame.depth_image,
                                    .view = frame.depth_view,
                                    .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                    .layout = frame.depth_layout},
                          .light_count = frame.light_count,
                          .host_lights = frame.host_lights,
                          .host_frame = &record};
  Recorder recorder(device_, commands, tracker_);
  tracker_.assume(inputs.depth);
  tracker_.assume(Resource::storage(inputs.lights));
  if (!makes_spheres) tracker_.assume(Resource::storage(inputs.spheres));

  recorder.barrier({{.resource = Resource::storage(frame_.handle()),
                     .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                     .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  vkCmdUpdateBuffer(commands, frame_.handle(), 0, sizeof(record), &record);
  if (makes_spheres) make_spheres(recorder, inputs);
  runner_.record(recorder, inputs);

  std::vector<Use> readers;
  for (const Bound& bound : runner_.lookup(inputs).resources)
    if (bound.resource.buffer != VK_NULL_HANDLE)
      readers.push_back({.resource = bound.resource,
                         .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                         .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
  recorder.barrier(readers);
  runner_.record_counts(recorder, counts_, frames_ % FRAMES_IN_FLIGHT * count_bytes(runner_.plan()));
  return frames_;
}

void Culler::make_spheres(Recorder& recorder, const PlanInputs& inputs) const {
  const Resource frame = Resource::storage(inputs.frame);
  const Resource lights = Resource::storage(inputs.lights);
  const Resource spheres = Resource::storage(inputs.spheres);
  recorder.begin_pass("light spheres", {{.resource = frame},
                                        {.resource = lights},
                                        {.resource = spheres, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
  recorder.bind(sphere_pipeline_, std::array{Bound{0, frame}, Bound{1, lights}, Bound{2, spheres}});
  if (inputs.light_count > 0)
    vkCmdDispatch(recorder.commands(), (inputs.light_count + SPHERE_THREADS - 1) / SPHERE_THREADS, 1, 1);
  recorder.end_pass();
}

BoundLookUp Culler::lookup() const { return runner_.lookup({.frame = frame_.handle()}); }

FrameCounts Culler::counts_of(std::uint64_t frame) const {
  const std::uint64_t bytes = count_bytes(runner_.plan());
  return read_counts(runner_.plan(), counts_.mapped().subspan(frame % FRAMES_IN_FLIGHT * bytes, bytes));
}

void Culler::release(std::uint64_t finished_frame) {
  for (const Retired& retired : retired_)
    for (ResourceId id = PLAN_BUFFER;
         retired.last_frame <= finished_frame && id - PLAN_BUFFER < retired.runner.plan().buffers.size(); ++id)
      tracker_.forget(retired.runner.buffer(id));
  std::erase_if(retired_, [&](const Retired& retired) { return retired.last_frame <= finished_frame; });
}

Result<Growth> Culler::finish(std::uint64_t frame) {
  assert(frame >= 1 && frame <= frames_ && frame + FRAMES_IN_FLIGHT > frames_ && "finish frames soon after they ran");
  release(frame);
  if (frame < first_frame_ || runner_.plan().counters == NO_RESOURCE) return Growth::none;
  std::optional<GrownPlan> grown = grow_plan(*method_, problem_, runner_.plan(), counts_of(frame).needed);
  return grown ? grow(std::move(*grown)) : Result<Growth>(Growth::none);
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
