// Records the pass that makes radial bounds, or meshes.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_reach.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "lamplight/shared/light_mesh.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t MOST_GROUPS_X = 32768;

/// The first lights, as many as a buffer of the device holds: nothing cuts others.
std::uint32_t lights_of(const vulkan::Device& device, std::uint64_t bytes, std::uint32_t light_capacity) {
  const std::uint64_t most = device.traits.max_storage_buffer_bytes / bytes;
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(light_capacity, 1, most));
}

/// What tells the two apart.
struct Made {
  const char* name;
  const char* shader;
  std::uint64_t bytes;  ///< a light
};

Made made(ShadowReach::Kind kind) {
  if (kind == ShadowReach::Kind::meshes) return {"light meshes", "shadow/light_meshes", sizeof(shared::LightMesh)};
  return {"radial bounds", "shadow/radial_bounds", sizeof(shared::RadialBound)};
}

/// Of a group that makes a light's bound: large ones are soon done with a large map, and idle with a small one.
std::uint32_t bound_threads(const vulkan::Device& device, std::uint64_t texels_a_light) {
  constexpr std::uint64_t TEXELS_A_THREAD = 64;
  const std::uint64_t wanted = std::clamp<std::uint64_t>(std::bit_floor(texels_a_light / TEXELS_A_THREAD), 256, 1024);
  return std::min(static_cast<std::uint32_t>(wanted), std::bit_floor(device.traits.max_group_invocations));
}

/// Meshes are fitted on a finer lattice where shared memory has room for it.
std::vector<vulkan::Constant> constants_of(const vulkan::Device& device, ShadowReach::Kind kind, ShadowFilter filter,
                                           std::uint64_t texels_a_light) {
  constexpr std::uint32_t FINE_BYTES = 24576;
  const std::uint32_t second = kind == ShadowReach::Kind::radial                 ? bound_threads(device, texels_a_light)
                               : device.traits.shared_memory_bytes >= FINE_BYTES ? 6U
                                                                                 : 4U;
  return {{0, static_cast<std::uint32_t>(filter)}, {1, second}};
}

}  // namespace

ShadowReach::ShadowReach(const vulkan::Device& device, const ShaderLibrary& shaders, Kind kind, ShadowFilter filter,
                         std::uint32_t light_capacity, std::uint32_t atlas_size)
    : name_(made(kind).name), pending_(lights_of(device, made(kind).bytes, light_capacity)) {
  const auto [name, shader, bytes] = made(kind);
  const std::uint64_t lights = pending_.size();
  buffer_ = take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = lights * bytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT}));
  jobs_ = take(vulkan::Buffer::create(device, {.name = "jobs of shadow maps",
                                               .bytes = lights * sizeof(shared::RadialJob),
                                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                               .memory = vulkan::MemoryUse::upload}));
  pipeline_ = take(vulkan::Pipeline::compute(
      device,
      {.name = name,
       .constants = constants_of(device, kind, filter, std::uint64_t{atlas_size} * atlas_size / lights),
       .bindings = {{0}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {3}, {4}},
       .push_constant_bytes = sizeof(std::uint32_t)},
      shaders.spirv(shader)));
}

void ShadowReach::add(std::span<const shared::RadialJob> jobs) {
  for (const shared::RadialJob& job : jobs)
    if (job.light < pending_.size()) pending_[job.light] = job;
}

std::vector<shared::RadialJob> ShadowReach::pending() const {
  std::vector<shared::RadialJob> jobs;
  for (const std::optional<shared::RadialJob>& pending : pending_)
    if (pending) jobs.push_back(*pending);
  return jobs;
}

void ShadowReach::record_nothing_known(vulkan::Recorder& recorder) {
  const vulkan::Resource all = vulkan::Resource::storage(buffer_.handle());
  recorder.barrier(
      {{.resource = all, .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  vkCmdFillBuffer(recorder.commands(), buffer_.handle(), 0, VK_WHOLE_SIZE, 0);
}

void ShadowReach::record(vulkan::Recorder& recorder, const vulkan::Resource& maps, const GpuImage& atlas) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  if (!std::exchange(begun_, true)) record_nothing_known(recorder);
  const std::vector<shared::RadialJob> pending_jobs = pending();
  if (pending_jobs.empty()) return;
  std::memcpy(jobs_.mapped().data(), pending_jobs.data(), pending_jobs.size() * sizeof(pending_jobs[0]));
  std::ranges::fill(pending_, std::nullopt);
  const auto count = static_cast<std::uint32_t>(pending_jobs.size());
  recorder.begin_pass(name_, {});
  const vulkan::Resource written = vulkan::Resource::storage(buffer_.handle());
  const vulkan::Resource jobs = vulkan::Resource::storage(jobs_.handle());
  recorder.barrier({reads(maps, COMPUTE),
                    reads(atlas.sampled(), COMPUTE),
                    reads(jobs, COMPUTE),
                    {.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
  recorder.bind(pipeline_, std::vector<vulkan::Bound>{{0, maps}, {1, atlas.sampled()}, {3, jobs}, {4, written}});
  vkCmdPushConstants(recorder.commands(), pipeline_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(count), &count);
  const std::uint32_t wide = std::min(count, MOST_GROUPS_X);
  vkCmdDispatch(recorder.commands(), wide, (count + wide - 1) / wide, 1);
  recorder.end_pass();
}

}  // namespace lamp::app
