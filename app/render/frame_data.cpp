// Uploads camera, lights and decals.
// SPDX-License-Identifier: Apache-2.0
#include "render/frame_data.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "lamplight/light.h"
#include "render/decal_pass.h"
#include "render/pass_uses.h"

namespace lamp::app {

FrameData::FrameData(const vulkan::Device& device, std::uint32_t light_capacity, std::uint32_t decal_capacity) {
  const std::uint64_t records = std::uint64_t{light_capacity} + decal_capacity;
  const std::uint64_t light_bytes = std::max<std::uint64_t>(1, records) * sizeof(shared::Light);
  const std::uint64_t sphere_bytes = std::max<std::uint64_t>(1, records) * sizeof(shared::LightSphere);
  const std::uint64_t decal_bytes = std::max<std::uint64_t>(1, decal_capacity) * sizeof(gpu::DecalData);
  constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  frame_ = take(vulkan::Buffer::create(
      device,
      {.name = "frame", .bytes = sizeof(shared::Frame), .usage = STORAGE | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT}));
  lights_ = take(vulkan::Buffer::create(device, {.name = "lights", .bytes = light_bytes, .usage = STORAGE}));
  spheres_ = take(vulkan::Buffer::create(device, {.name = "spheres", .bytes = sphere_bytes, .usage = STORAGE}));
  decals_ = take(vulkan::Buffer::create(device, {.name = "decals", .bytes = decal_bytes, .usage = STORAGE}));
  staging_ =
      take(vulkan::Buffer::create(device, {.name = "frame staging",
                                           .bytes = sizeof(shared::Frame) + light_bytes + sphere_bytes + decal_bytes,
                                           .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                           .memory = vulkan::MemoryUse::upload}));
}

void FrameData::set(const View& view, std::span<const shared::Light> lights, std::span<const gpu::DecalData> decals) {
  assert((lights.size() + decals.size()) * sizeof(shared::Light) <= lights_.bytes() &&
         decals.size_bytes() <= decals_.bytes() && "make FrameData with a larger capacity");
  host_lights_ = entity_records(lights, boxes_of(decals));
  // Room for as many as there are: plans of any capacity from there on take it.
  const auto count = static_cast<std::uint32_t>(host_lights_.size());
  host_frame_ = view.frame(count, count);
  host_frame_.box_count = static_cast<std::uint32_t>(decals.size());
  changed_ = true;
  const std::span<std::byte> to = staging_.mapped();
  const auto put = [&](std::uint64_t offset, std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(to.subspan(offset).data(), bytes.data(), bytes.size());
  };
  put(0, std::as_bytes(std::span(&host_frame_, 1)));
  put(sizeof(host_frame_), std::as_bytes(std::span(host_lights_)));
  const std::vector<shared::LightSphere> spheres = bounding_spheres(host_lights_);
  put(sizeof(host_frame_) + lights_.bytes(), std::as_bytes(std::span(spheres)));
  put(sizeof(host_frame_) + lights_.bytes() + spheres_.bytes(), std::as_bytes(decals));
}

void FrameData::set_view(const View& view) {
  const std::uint32_t boxes = host_frame_.box_count;
  host_frame_ = view.frame(host_frame_.light_count, host_frame_.light_capacity);
  host_frame_.box_count = boxes;
  std::memcpy(staging_.mapped().data(), &host_frame_, sizeof(host_frame_));
  changed_ = true;
}

void FrameData::record_upload(vulkan::Recorder& recorder) {
  if (!std::exchange(changed_, false)) return;
  recorder.barrier({copies_to(frame()), copies_to(lights()), copies_to(spheres()), copies_to(decals())});
  const auto copy = [&](const vulkan::Buffer& buffer, std::uint64_t offset, std::uint64_t bytes) {
    const VkBufferCopy part{.srcOffset = offset, .size = bytes};
    if (bytes != 0) vkCmdCopyBuffer(recorder.commands(), staging_.handle(), buffer.handle(), 1, &part);
  };
  copy(frame_, 0, sizeof(shared::Frame));
  copy(lights_, sizeof(shared::Frame), host_lights_.size() * sizeof(shared::Light));
  copy(spheres_, sizeof(shared::Frame) + lights_.bytes(), host_lights_.size() * sizeof(shared::LightSphere));
  copy(decals_, sizeof(shared::Frame) + lights_.bytes() + spheres_.bytes(),
       host_frame_.box_count * sizeof(gpu::DecalData));
}

vulkan::PlanInputs FrameData::plan_inputs(const vulkan::Resource& depth) const {
  return {.frame = frame_.handle(),
          .lights = lights_.handle(),
          .spheres = spheres_.handle(),
          .depth = depth,
          .host_lights = host_lights_,
          .host_frame = &host_frame_};
}

}  // namespace lamp::app
