// Uploads camera and lights.
// SPDX-License-Identifier: Apache-2.0
#include "render/frame_data.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "gpu/check.h"
#include "render/pass_uses.h"

namespace lamp::app {

FrameData::FrameData(const vulkan::Device& device, std::uint32_t light_capacity) {
  const std::uint64_t light_bytes = std::max<std::uint64_t>(1, light_capacity) * sizeof(shared::Light);
  constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  frame_ = take(vulkan::Buffer::create(device, {.name = "frame", .bytes = sizeof(shared::Frame), .usage = STORAGE}));
  lights_ = take(vulkan::Buffer::create(device, {.name = "lights", .bytes = light_bytes, .usage = STORAGE}));
  staging_ = take(vulkan::Buffer::create(device, {.name = "frame staging",
                                                  .bytes = sizeof(shared::Frame) + light_bytes,
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                  .memory = vulkan::MemoryUse::upload}));
}

void FrameData::set(const View& view, std::span<const shared::Light> lights) {
  assert(lights.size_bytes() <= lights_.bytes() && "make FrameData with a larger light capacity");
  host_frame_ = view.frame(static_cast<std::uint32_t>(lights.size()));
  host_lights_.assign(lights.begin(), lights.end());
  std::memcpy(staging_.mapped().data(), &host_frame_, sizeof(host_frame_));
  if (!lights.empty())
    std::memcpy(staging_.mapped().subspan(sizeof(host_frame_)).data(), lights.data(), lights.size_bytes());
}

void FrameData::record_upload(vulkan::Recorder& recorder) const {
  recorder.barrier({copies_to(frame()), copies_to(lights())});
  const VkBufferCopy frame_copy{.size = sizeof(shared::Frame)};
  vkCmdCopyBuffer(recorder.commands(), staging_.handle(), frame_.handle(), 1, &frame_copy);
  if (host_lights_.empty()) return;
  const VkBufferCopy light_copy{.srcOffset = sizeof(shared::Frame),
                                .size = host_lights_.size() * sizeof(shared::Light)};
  vkCmdCopyBuffer(recorder.commands(), staging_.handle(), lights_.handle(), 1, &light_copy);
}

vulkan::PlanInputs FrameData::plan_inputs(const vulkan::Resource& depth) const {
  return {.frame = frame_.handle(),
          .lights = lights_.handle(),
          .depth = depth,
          .light_count = host_frame_.light_count,
          .host_lights = host_lights_,
          .host_frame = &host_frame_};
}

}  // namespace lamp::app
