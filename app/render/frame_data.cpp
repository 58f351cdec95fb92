// Uploads camera, lights, decals and the records of probes.
// SPDX-License-Identifier: Apache-2.0
#include "render/frame_data.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "lamplight/light.h"
#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/radial.h"
#include "render/decal_pass.h"
#include "render/pass_uses.h"
#include "render/probe_set.h"

namespace lamp::app {

FrameData::FrameData(const vulkan::Device& device, std::uint32_t light_capacity, std::uint32_t decal_capacity,
                     std::uint32_t views)
    : host_frames_(views) {
  const std::uint64_t records = std::uint64_t{light_capacity} + decal_capacity;
  const std::uint64_t light_bytes = std::max<std::uint64_t>(1, records) * sizeof(shared::Light);
  const std::uint64_t sphere_bytes = std::max<std::uint64_t>(1, records) * sizeof(shared::LightSphere);
  const std::uint64_t decal_bytes = std::max<std::uint64_t>(1, decal_capacity) * sizeof(gpu::DecalData);
  constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  frame_ = take(vulkan::Buffer::create(device, {.name = "frame",
                                                .bytes = views * sizeof(shared::Frame),
                                                .usage = STORAGE | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT}));
  constexpr VkBufferUsageFlags READ_BACK = STORAGE | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;  // by who checks what moves
  lights_ = take(vulkan::Buffer::create(device, {.name = "lights", .bytes = light_bytes, .usage = READ_BACK}));
  spheres_ = take(vulkan::Buffer::create(device, {.name = "spheres", .bytes = sphere_bytes, .usage = READ_BACK}));
  decals_ = take(vulkan::Buffer::create(device, {.name = "decals", .bytes = decal_bytes, .usage = STORAGE}));
  nothing_known_ =
      take(vulkan::Buffer::create(device, {.name = "nothing known of lights",
                                           .bytes = std::max(sizeof(shared::RadialBound), sizeof(shared::LightMesh)),
                                           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                           .memory = vulkan::MemoryUse::upload}));
  std::ranges::fill(nothing_known_.mapped(), std::byte{0});
  staging_ = take(vulkan::Buffer::create(device, {.name = "frame staging",
                                                  .bytes = frame_.bytes() + light_bytes + sphere_bytes + decal_bytes,
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                  .memory = vulkan::MemoryUse::upload}));
}

void FrameData::set(std::span<const View> views, std::span<const shared::Light> lights,
                    std::span<const gpu::DecalData> decals, std::uint32_t still,
                    std::span<const gpu::ProbeData> probes) {
  assert((lights.size() + decals.size() + probes.size()) * sizeof(shared::Light) <= lights_.bytes() &&
         decals.size_bytes() <= decals_.bytes() && "make FrameData with a larger capacity");
  assert(views.size() == host_frames_.size() && "as many views as FrameData was made for");
  assert(still <= lights.size() && "as many lights as stand still");
  const std::size_t moving = lights.size() - still;
  host_lights_ = entity_records(lights.first(moving), boxes_of(decals));
  for (const gpu::ProbeData& probe : probes) host_lights_.push_back(bounding_light(probe.volume, shape_of(probe)));
  // Room for as many as there are: plans of any capacity from there on take it.
  const auto count = static_cast<std::uint32_t>(host_lights_.size());
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    host_frames_[i] = views[i].frame(count, count);
    host_frames_[i].box_count = static_cast<std::uint32_t>(decals.size() + probes.size());
    host_frames_[i].probe_count = static_cast<std::uint32_t>(probes.size());
    host_frames_[i].view_index = i;
  }
  host_lights_.insert(host_lights_.end(), lights.begin() + static_cast<std::ptrdiff_t>(moving), lights.end());
  changed_ = true;
  std::span<std::byte> to = staging_.mapped();
  const auto put = [&](const vulkan::Buffer& buffer, std::span<const std::byte> bytes) {
    if (!bytes.empty()) std::memcpy(to.data(), bytes.data(), bytes.size());
    to = to.subspan(buffer.bytes());
  };
  const std::vector<shared::LightSphere> spheres = bounding_spheres(host_lights_);
  put(frame_, std::as_bytes(std::span(host_frames_)));
  put(lights_, std::as_bytes(std::span(host_lights_)));
  put(spheres_, std::as_bytes(std::span(spheres)));
  put(decals_, std::as_bytes(decals));
}

void FrameData::set_view(const View& view, std::uint32_t index) {
  assert(host_frames_.size() == 1 && "of one view at a time");
  shared::Frame& frame = host_frames_.front();
  const shared::Frame counted = frame;
  frame = view.frame(frame.light_count, frame.light_capacity);
  frame.box_count = counted.box_count;
  frame.probe_count = counted.probe_count;
  frame.view_index = index;
  std::memcpy(staging_.mapped().data(), &frame, sizeof(frame));
  view_changed_ = true;
}

void FrameData::take_cells_of(const Plan& plan) {
  for (std::size_t i = 0; i < host_frames_.size(); ++i) {
    shared::Frame& frame = host_frames_[i];
    const std::uint32_t shift = plan.cell_shift(frame.size_px.x, frame.size_px.y);
    if (std::exchange(frame.cell_shift, shift) == shift) continue;
    std::memcpy(staging_.mapped().subspan(i * sizeof(frame)).data(), &frame, sizeof(frame));
    view_changed_ = true;
  }
}

float FrameData::farthest_eye_m() const {
  float farthest = 0.0F;
  for (const shared::Frame& frame : host_frames_)
    farthest = std::max(farthest, glm::length(glm::vec3(Vec3(frame.eye_world))));
  return farthest;
}

void FrameData::set_still(Context& context, std::span<const std::uint32_t> words) {
  still_ = upload_buffer(context, "still lights", std::as_bytes(words), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

void FrameData::record_upload(vulkan::Recorder& recorder) {
  const bool all = std::exchange(changed_, false);
  if (!std::exchange(view_changed_, false) && !all) return;
  if (all)
    recorder.barrier({copies_to(frame()), copies_to(lights()), copies_to(spheres()), copies_to(decals())});
  else
    recorder.barrier({copies_to(frame())});
  std::uint64_t offset = 0;
  const auto copy = [&](const vulkan::Buffer& buffer, std::uint64_t bytes) {
    const VkBufferCopy part{.srcOffset = offset, .size = bytes};
    if (bytes != 0) vkCmdCopyBuffer(recorder.commands(), staging_.handle(), buffer.handle(), 1, &part);
    offset += buffer.bytes();
  };
  copy(frame_, frame_.bytes());
  if (!all) return;
  copy(lights_, host_lights_.size() * sizeof(shared::Light));
  copy(spheres_, host_lights_.size() * sizeof(shared::LightSphere));
  copy(decals_, entities().decals.count() * sizeof(gpu::DecalData));
}

vulkan::PlanInputs FrameData::plan_inputs(std::span<const vulkan::Resource> depths) const {
  return {.frame = frame_.handle(),
          .lights = lights_.handle(),
          .spheres = spheres_.handle(),
          .radial = nothing_known_.handle(),
          .meshes = nothing_known_.handle(),
          .still = still_.handle(),
          .depth = depths.front(),
          .depths = depths,
          .host_lights = std::span(host_lights_).first(frame_of(0).light_count),
          .host_frame = host_frames_.data()};
}

}  // namespace lamp::app
