// Records mirrored light: lists, rays, surfaces, shading.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "gpu/check.h"
#include "render/lighting.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr std::uint32_t GROUP_PX = 8;
constexpr std::uint32_t CONSTANT_STACK = 30;
constexpr std::uint32_t CONSTANT_WALKS_ALONE = 31;
constexpr VkDescriptorType STORAGE = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

constexpr std::array<std::string_view, 3> LISTS{"world-cells", "ikkala-grid", "brute-force"};
constexpr std::array<const char*, 3> METHODS{"world-cells", "ikkala-grid", "all"};

vulkan::Use writes(const vulkan::Buffer& buffer) {
  return {.resource = vulkan::Resource::storage(buffer.handle()),
          .stages = COMPUTE,
          .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
}

/// What all three passes read of a pixel.
std::vector<vulkan::Bound> pixel_bound(const LightingFrame& frame) {
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  bound.push_back({0, frame.data.frame_constants()});
  return bound;
}

std::vector<vulkan::DescriptorBinding> pixel_bindings() {
  std::vector<vulkan::DescriptorBinding> bindings{{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}};
  for (const std::uint32_t binding : {1U, 5U, 6U, 7U}) bindings.push_back({binding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE});
  return bindings;
}

std::vector<vulkan::Use> reads_all(const std::vector<vulkan::Bound>& bound) {
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, COMPUTE));
  return uses;
}

void append(std::vector<vulkan::Bound>& to, const std::vector<vulkan::Bound>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

vulkan::Buffer pixel_buffer(const vulkan::Device& device, const MirrorInfo& info, const char* name,
                            std::uint64_t bytes) {
  const std::uint64_t all = std::uint64_t{info.width} * info.height * bytes;
  if (all > device.traits.max_storage_buffer_bytes)
    throw Error(fmt::format("--mirror: a picture of {}x{} takes {} MB for its {}, expected at most {} on this device",
                            info.width, info.height, all / 1'000'000, name,
                            device.traits.max_storage_buffer_bytes / 1'000'000));
  return take(
      vulkan::Buffer::create(device, {.name = name,
                                      .bytes = std::max<std::uint64_t>(all, 16),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT}));
}

}  // namespace

std::span<const std::string_view> mirror_list_names() { return LISTS; }

Plan mirror_plan(const vulkan::Device& device, const MirrorInfo& info) {
  const Method& method = *take(find_method(METHODS[static_cast<std::size_t>(info.settings.lists)]));
  return take(make_plan(method, {.width = info.width,
                                 .height = info.height,
                                 .light_capacity = info.light_capacity,
                                 .options = take(resolve_options(method, {})),
                                 .traits = device.traits}));
}

MirrorPipelines mirror_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders, const MirrorInfo& info,
                                 const Plan& plan, std::uint32_t stack) {
  vulkan::PipelineInfo rays{.name = "mirror trace",
                            .constants = {{CONSTANT_STACK, std::max(stack, 1U)}},
                            .bindings = pixel_bindings(),
                            .push_constant_bytes = sizeof(gpu::MirrorPush)};
  rays.bindings.push_back({2, STORAGE});
  rays.bindings.push_back({3, STORAGE});
  for (std::uint32_t binding = 8; binding < 16; ++binding) rays.bindings.push_back({binding, STORAGE});
  vulkan::PipelineInfo surfaces = rays;
  surfaces.name = "mirror surfaces";
  surfaces.constants.clear();
  vulkan::PipelineInfo shade{.name = "mirror shading",
                             .constants = vulkan::lookup_constants(plan.lookup),
                             .bindings = pixel_bindings(),
                             .push_constant_bytes = sizeof(gpu::MirrorPush)};
  shade.constants.push_back({CONSTANT_BRDF, static_cast<std::uint32_t>(info.settings.brdf)});
  shade.bindings.push_back({2, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE});
  for (const std::uint32_t binding : {3U, 4U, 8U, 9U, 10U}) shade.bindings.push_back({binding, STORAGE});
  add_shadows(shade, info.shadows);
  for (const vulkan::DescriptorBinding& binding : vulkan::lookup_bindings(plan.lookup))
    shade.bindings.push_back(binding);
  vulkan::PipelineInfo walk = shade;
  walk.name = "mirror look-ups";
  walk.constants.push_back({CONSTANT_WALKS_ALONE, 1});
  const auto make = [&](const vulkan::PipelineInfo& of, const std::string& shader) {
    return take(vulkan::Pipeline::compute(device, of, shaders.spirv(shader)));
  };
  return {.trace = make(rays, "mirror_trace"),
          .surfaces = make(surfaces, "mirror_surfaces"),
          .shade = make(shade, "mirror_shade_" + std::string(plan.lookup.name)),
          .walk = make(walk, "mirror_shade_" + std::string(plan.lookup.name))};
}

MirrorPass::MirrorPass(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const MirrorInfo& info)
    : of_(scene.scene()), info_(info), scene_(context, scene) {
  const vulkan::Device& device = context.device();
  hits_ = pixel_buffer(device, info, "mirror hits", sizeof(gpu::MirrorHit));
  surfaces_ = pixel_buffer(device, info, "mirrored surfaces", sizeof(gpu::MirrorSurface));
  if (info.settings.walks_apart)
    walked_ = pixel_buffer(device, info, "walked lights", sizeof(std::uint32_t));
  else
    walked_ = readback_buffer(device, "walked lights", 0);  // something to bind
  counts_ = take(
      vulkan::Buffer::create(device, {.name = "mirror counts",
                                      .bytes = sizeof(gpu::MirrorCounts),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT}));
  read_counts_ = readback_buffer(device, "mirror counts read-back", sizeof(gpu::MirrorCounts));
  std::ranges::fill(read_counts_.mapped(), std::byte{0});
  Plan plan = mirror_plan(device, info);
  MirrorPipelines pipelines = mirror_pipelines(device, shaders, info, plan, scene_.bvh().stack);
  trace_ = std::move(pipelines.trace);
  find_surfaces_ = std::move(pipelines.surfaces);
  shade_ = std::move(pipelines.shade);
  walk_ = std::move(pipelines.walk);
  runner_ = take(vulkan::PlanRunner::create(device, std::move(plan), shaders.source()));
}

vulkan::PlanInputs MirrorPass::inputs(const LightingFrame& frame) const {
  const vulkan::Resource depth = frame.targets.depth.sampled();
  vulkan::PlanInputs inputs = frame.data.plan_inputs({&depth, 1});
  inputs.depths = {};
  return inputs;
}

void MirrorPass::record(vulkan::Recorder& recorder, const LightingFrame& frame) {
  scene_.record_upload(recorder);
  recorder.name_group("mirror");
  static_cast<void>(take(runner_.record(recorder, inputs(frame))));
  trace(recorder, frame);
  find_surfaces(recorder, frame);
  if (info_.settings.walks_apart) shade(recorder, frame, /*walks_alone=*/true);
  shade(recorder, frame, /*walks_alone=*/false);
  recorder.name_group("");
}

void MirrorPass::dispatch(vulkan::Recorder& recorder, const char* name, const vulkan::Pipeline& pipeline,
                          const std::vector<vulkan::Bound>& bound, const std::vector<vulkan::Use>& uses) const {
  const gpu::MirrorPush push{.roughness = info_.settings.roughness, .root = scene_.bvh().root, .two = 2};
  recorder.begin_pass(name, uses);
  recorder.bind(pipeline, bound);
  vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), &push);
  vkCmdDispatch(recorder.commands(), (info_.width + GROUP_PX - 1) / GROUP_PX, (info_.height + GROUP_PX - 1) / GROUP_PX,
                1);
  recorder.end_pass();
}

void MirrorPass::trace(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const vulkan::Resource counts = vulkan::Resource::storage(counts_.handle());
  recorder.barrier(
      {{.resource = counts, .stages = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, .access = VK_ACCESS_2_TRANSFER_WRITE_BIT}});
  vkCmdFillBuffer(recorder.commands(), counts_.handle(), 0, VK_WHOLE_SIZE, 0);
  std::vector<vulkan::Bound> bound = pixel_bound(frame);
  append(bound, scene_.bound());
  std::vector<vulkan::Use> uses = reads_all(bound);
  uses.push_back(writes(hits_));
  uses.push_back(changes(counts));
  append(bound, {{2, vulkan::Resource::storage(hits_.handle())}, {3, counts}});
  dispatch(recorder, "trace", trace_, bound, uses);
}

void MirrorPass::find_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame) {
  std::vector<vulkan::Bound> bound = pixel_bound(frame);
  append(bound, scene_.bound());
  append(bound, {{2, vulkan::Resource::storage(hits_.handle())}});
  std::vector<vulkan::Use> uses = reads_all(bound);
  uses.push_back(writes(surfaces_));
  append(bound, {{3, vulkan::Resource::storage(surfaces_.handle())}});
  dispatch(recorder, "surfaces", find_surfaces_, bound, uses);
}

void MirrorPass::shade(vulkan::Recorder& recorder, const LightingFrame& frame, bool walks_alone) {
  const vulkan::BoundLookUp walked = runner_.lookup(inputs(frame));
  std::vector<vulkan::Bound> bound = pixel_bound(frame);
  append(bound, {{3, frame.data.lights()},
                 {4, frame.scene.surroundings()},
                 {8, vulkan::Resource::storage(hits_.handle())},
                 {9, vulkan::Resource::storage(surfaces_.handle())}});
  bound.insert(bound.end(), frame.shadows.begin(), frame.shadows.end());
  std::vector<vulkan::Use> uses = reads_all(bound);
  for (const vulkan::Use& use : walked.buffer_uses(COMPUTE)) uses.push_back(use);
  uses.push_back(changes(frame.targets.hdr.storage()));
  if (walks_alone) uses.push_back(writes(walked_));
  append(bound, {{2, frame.targets.hdr.storage()}, {10, vulkan::Resource::storage(walked_.handle())}});
  append(bound, walked.resources);
  dispatch(recorder, walks_alone ? "look-ups" : "shading", walks_alone ? walk_ : shade_, bound, uses);
}

void MirrorPass::record_counts(vulkan::Recorder& recorder) {
  const vulkan::Resource to = vulkan::Resource::storage(read_counts_.handle());
  recorder.barrier({copies_from(vulkan::Resource::storage(counts_.handle())), copies_to(to)});
  const VkBufferCopy all{.size = sizeof(gpu::MirrorCounts)};
  vkCmdCopyBuffer(recorder.commands(), counts_.handle(), read_counts_.handle(), 1, &all);
  recorder.barrier({host_reads(to)});
  runner_.record_counts(recorder);
}

gpu::MirrorCounts MirrorPass::counts() const {
  gpu::MirrorCounts counts{};
  std::memcpy(&counts, read_counts_.mapped().data(), sizeof(counts));
  return counts;
}

std::uint32_t MirrorPass::overflowed_cells() const { return runner_.counts().counters.overflowed_cells; }

void MirrorPass::finish() {
  if (runner_.records() != 0) runner_.finish(runner_.records());
}

void MirrorPass::move(Context& context) { scene_.move(context, of_); }

std::vector<std::pair<std::string, std::uint64_t>> MirrorPass::bytes() const {
  return {{"mirror lists", runner_.plan().bytes()},
          {"mirror scene", scene_.bytes()},
          {"mirror hits", hits_.bytes() + surfaces_.bytes()}};
}

}  // namespace lamp::app
