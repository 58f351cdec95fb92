// Records the pass that makes radial bounds, or meshes.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_reach.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

#include "gpu/check.h"
#include "lamplight/shared/light_mesh.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t MOST_GROUPS_X = 32768;
constexpr std::size_t SPARE_JOBS = 1U << 16;  ///< beyond one a light

/// Groups that make bounds. A large map would keep one busy for long, so several share it.
struct BoundGroups {
  std::uint32_t threads;
  std::uint32_t texels;  ///< a group's part of a map
};
constexpr std::size_t FEW_LIGHTS = 128;
constexpr BoundGroups FOR_FEW{384, 6144};  ///< lights, which leave most of a device idle
constexpr BoundGroups FOR_MANY{128, 12288};

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

/// Constant 1 of the shader, of each pipeline: threads of a group, for many lights and for few; or the side of the
/// lattice on which meshes are fitted, finer where shared memory has room for it.
std::vector<std::uint32_t> second_constants(const vulkan::Device& device, ShadowReach::Kind kind) {
  constexpr std::uint32_t FINE_BYTES = 24576;
  if (kind == ShadowReach::Kind::meshes) return {device.traits.shared_memory_bytes >= FINE_BYTES ? 6U : 4U};
  const std::uint32_t most = device.traits.max_group_invocations;
  return {std::min(FOR_MANY.threads, most), std::min(FOR_FEW.threads, most)};
}

std::uint32_t parts_of(const shared::ShadowMap& map, std::uint32_t texels) {
  const std::uint32_t squares = map.kind == shared::SHADOW_FACES ? shared::SQUARES_A_LIGHT : 1;
  return std::clamp(squares * map.side * map.side / texels, 1U, shared::RADIAL_MOST_PARTS);
}

/// Lights with several parts first, the largest before others, since the pass lasts until the last group is done.
std::vector<shared::RadialJob> in_parts(std::vector<shared::RadialJob> whole, std::span<const shared::ShadowMap> maps,
                                        std::uint32_t texels) {
  for (shared::RadialJob& job : whole) job.parts = job.light < maps.size() ? parts_of(maps[job.light], texels) : 1;
  std::ranges::sort(whole, std::greater(), [](const auto& job) { return std::pair(job.parts, ~job.light); });
  std::size_t spare = SPARE_JOBS;
  std::vector<shared::RadialJob> jobs;
  for (shared::RadialJob job : whole) {
    if (job.parts > spare + 1) job.parts = 1;
    spare -= job.parts - 1;
    for (job.part = 0; job.part < job.parts; ++job.part) jobs.push_back(job);
  }
  return jobs;
}

/// A group for each job.
void dispatch_jobs(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline, std::size_t jobs) {
  const auto count = static_cast<std::uint32_t>(jobs);
  vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(count), &count);
  const std::uint32_t wide = std::min(count, MOST_GROUPS_X);
  vkCmdDispatch(recorder.commands(), wide, (count + wide - 1) / wide, 1);
}

}  // namespace

ShadowReach::ShadowReach(const vulkan::Device& device, const ShaderLibrary& shaders, Kind kind, ShadowFilter filter,
                         std::uint32_t light_capacity)
    : kind_(kind), pending_(lights_of(device, made(kind).bytes, light_capacity)) {
  const auto [name, shader, bytes] = made(kind);
  const std::uint64_t lights = pending_.size();
  buffer_ = take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = lights * bytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT}));
  jobs_ = take(vulkan::Buffer::create(device, {.name = "jobs of shadow maps",
                                               .bytes = (lights + SPARE_JOBS) * sizeof(shared::RadialJob),
                                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                               .memory = vulkan::MemoryUse::upload}));
  for (const std::uint32_t second : second_constants(device, kind))
    pipelines_.push_back(
        take(vulkan::Pipeline::compute(device,
                                       {.name = name,
                                        .constants = {{0, static_cast<std::uint32_t>(filter)}, {1, second}},
                                        .bindings = {{0}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {3}, {4}},
                                        .push_constant_bytes = sizeof(std::uint32_t)},
                                       shaders.spirv(shader))));
  if (kind == Kind::meshes) return;
  clear_ = take(vulkan::Pipeline::compute(
      device, {.name = "clear radial bounds", .bindings = {{3}, {4}}, .push_constant_bytes = sizeof(std::uint32_t)},
      shaders.spirv("shadow/clear_radial_bounds")));
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

void ShadowReach::record(vulkan::Recorder& recorder, const ShadowReachInput& input) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  if (!std::exchange(begun_, true)) record_nothing_known(recorder);
  std::vector<shared::RadialJob> jobs = pending();
  if (jobs.empty()) return;
  const bool few = jobs.size() <= FEW_LIGHTS;
  const vulkan::Pipeline& pipeline = few ? pipelines_.back() : pipelines_.front();
  if (kind_ == Kind::radial) jobs = in_parts(std::move(jobs), input.host_maps, (few ? FOR_FEW : FOR_MANY).texels);
  std::memcpy(jobs_.mapped().data(), jobs.data(), jobs.size() * sizeof(jobs[0]));
  std::ranges::fill(pending_, std::nullopt);
  const vulkan::Bound job_buffer{3, vulkan::Resource::storage(jobs_.handle())};
  const vulkan::Bound written{4, vulkan::Resource::storage(buffer_.handle())};
  recorder.begin_pass(made(kind_).name, {});
  recorder.barrier({reads(input.maps, COMPUTE), reads(input.atlas.sampled(), COMPUTE),
                    reads(job_buffer.resource, COMPUTE), changes(written.resource)});
  const auto last = std::find_if(jobs.rbegin(), jobs.rend(), [](const auto& job) { return job.parts > 1; });
  if (last != jobs.rend()) {
    recorder.bind(clear_, std::vector<vulkan::Bound>{job_buffer, written});
    dispatch_jobs(recorder, clear_, static_cast<std::size_t>(jobs.rend() - last));
    recorder.barrier({changes(written.resource)});
  }
  recorder.bind(pipeline, std::vector<vulkan::Bound>{{0, input.maps}, {1, input.atlas.sampled()}, job_buffer, written});
  dispatch_jobs(recorder, pipeline, jobs.size());
  recorder.end_pass();
}

}  // namespace lamp::app
