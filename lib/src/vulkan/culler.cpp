// The Culler: a plan runner, a frame buffer, a counter read-back.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vulkan/culler.h"

#include <cassert>
#include <cstring>

namespace lamp::vulkan {

Result<Culler> Culler::create(const Device& device, const CullerInfo& info) {
  const Result<const Method*> method = find_method(info.method);
  if (!method) return method.error();
  Result<Options> options = resolve_options(*method.value(), info.options);
  if (!options) return options.error();
  Result<Plan> plan = make_plan(*method.value(), {.width = info.width,
                                                  .height = info.height,
                                                  .light_capacity = info.light_capacity,
                                                  .options = std::move(options.value()),
                                                  .traits = device.traits});
  if (!plan) return plan.error();
  Result<PlanRunner> runner = PlanRunner::create(device, std::move(plan.value()));
  if (!runner) return runner.error();
  Result<Buffer> frame =
      Buffer::create(device, {.name = "frame",
                              .bytes = sizeof(shared::Frame),
                              .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
  if (!frame) return frame.error();
  Result<Buffer> counters = Buffer::create(device, {.name = "counters read-back",
                                                    .bytes = sizeof(shared::Counters),
                                                    .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                    .memory = MemoryUse::readback});
  if (!counters) return counters.error();
  std::memset(counters.value().mapped().data(), 0, sizeof(shared::Counters));

  Culler culler;
  culler.device_ = device;
  culler.frame_ = std::move(frame.value());
  culler.counters_ = std::move(counters.value());
  culler.runner_ = std::move(runner.value());
  return culler;
}

void Culler::record(VkCommandBuffer commands, const CullerFrame& frame) {
  assert(frame.view != nullptr && "set CullerFrame::view");
  const shared::Frame record = frame.view->frame(frame.light_count);
  const PlanInputs inputs{.frame = frame_.handle(),
                          .lights = frame.lights,
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

  recorder.barrier({{.resource = Resource::storage(frame_.handle()),
                     .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                     .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  vkCmdUpdateBuffer(commands, frame_.handle(), 0, sizeof(record), &record);
  runner_.record(recorder, inputs);

  std::vector<Use> readers;
  for (const Bound& bound : runner_.lookup(inputs).resources)
    if (bound.resource.buffer != VK_NULL_HANDLE)
      readers.push_back({.resource = bound.resource,
                         .stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                         .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT});
  recorder.barrier(readers);
  const VkBuffer counters = runner_.buffer(runner_.plan().counters);
  if (counters == VK_NULL_HANDLE) return;
  recorder.barrier({{.resource = Resource::storage(counters),
                     .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                     .access = VK_ACCESS_2_TRANSFER_READ_BIT},
                    {.resource = Resource::storage(counters_.handle()),
                     .stages = VK_PIPELINE_STAGE_2_COPY_BIT,
                     .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  const VkBufferCopy whole{.size = sizeof(shared::Counters)};
  vkCmdCopyBuffer(commands, counters, counters_.handle(), 1, &whole);
  recorder.barrier({{.resource = Resource::storage(counters_.handle()),
                     .stages = VK_PIPELINE_STAGE_2_HOST_BIT,
                     .access = VK_ACCESS_2_HOST_READ_BIT}});
}

BoundLookUp Culler::lookup() const { return runner_.lookup({.frame = frame_.handle()}); }

shared::Counters Culler::counters() const {
  shared::Counters counters{};
  std::memcpy(&counters, counters_.mapped().data(), sizeof(counters));
  return counters;
}

}  // namespace lamp::vulkan
