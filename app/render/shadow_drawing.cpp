// Finds the pairs of caster and view, a batch of views at a time.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_drawing.h"

#include <algorithm>

#include "gpu/check.h"
#include "gpu/transfer.h"

namespace lamp::app {
namespace {

// Pairs of caster and view that a batch has room for: 16 MiB. With more views than that there is a further batch, so
// nothing is lost whatever a scene has.
constexpr std::uint32_t BATCH_PAIRS = 1U << 22;
constexpr std::uint32_t MOST_BATCH_VIEWS = 32768;  // group counts along y have at least 16 bits
constexpr std::uint32_t CULL_GROUP = 64;

std::uint32_t views_a_batch(const ShadowCasters& casters, std::uint64_t most_views) {
  const auto count = std::max(1U, static_cast<std::uint32_t>(casters.casters.size()));
  const auto views = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(std::min<std::uint64_t>(BATCH_PAIRS / count, most_views), 1, MOST_BATCH_VIEWS));
  return (views + gpu::VIEWS_A_DRAW - 1) / gpu::VIEWS_A_DRAW * gpu::VIEWS_A_DRAW;
}

}  // namespace

vulkan::Buffer shadow_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes,
                             VkBufferUsageFlags usage) {
  return take(vulkan::Buffer::create(device, {.name = name,
                                              .bytes = std::max<std::uint64_t>(bytes, 16),
                                              .usage = usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}));
}

ShadowDrawing::ShadowDrawing(Context& context, const GpuScene& scene, const ShadowDrawingInfo& info,
                             const GpuImageInfo& atlas)
    : scene_(scene),
      casters_(shadow_casters(scene)),
      views_a_batch_(views_a_batch(casters_, info.most_views)),
      atlas_(context.device(), atlas) {
  caster_buffer_ =
      upload_buffer(context, "shadow casters", bytes_of(casters_.casters), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  pairs_ = shadow_buffer(context.device(), "shadow pairs",
                         casters_.casters.size() * views_a_batch_ * sizeof(std::uint32_t), 0);
}

vulkan::Pipeline ShadowDrawing::pair_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                              const char* shader, std::initializer_list<std::uint32_t> more,
                                              std::vector<vulkan::Constant> constants) const {
  vulkan::PipelineInfo info{.name = shader,
                            .constants = std::move(constants),
                            .bindings = {{0}, {1}, {2}, {4}},
                            .push_constant_bytes = sizeof(gpu::ShadowBatch)};
  for (const std::uint32_t binding : more) info.bindings.push_back({binding});
  return take(vulkan::Pipeline::compute(device, info, shaders.spirv(shader)));
}

void ShadowDrawing::record(vulkan::Recorder& recorder, const ShadowJob& job) {
  record_start(recorder, job);
  const auto count = static_cast<std::uint32_t>(job.host_views.size());
  for (std::uint32_t at = 0; at < count && !casters_.casters.empty(); at += views_a_batch_)
    record_batch(recorder, job, at, std::min(views_a_batch_, count - at));
}

void ShadowDrawing::record_pairs(vulkan::Recorder& recorder, const vulkan::Pipeline& pipeline,
                                 std::span<const vulkan::Bound> more, const ShadowJob& job, std::uint32_t first_view,
                                 std::uint32_t count, std::uint32_t views_a_thread) {
  const vulkan::Resource pairs = vulkan::Resource::storage(pairs_.handle());
  recorder.barrier({changes(pairs), reads(job.views, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)});
  std::vector<vulkan::Bound> bound{
      {0, job.views}, {1, vulkan::Resource::storage(caster_buffer_.handle())}, {2, scene_.instances()}, {4, pairs}};
  bound.insert(bound.end(), more.begin(), more.end());
  recorder.bind(pipeline, bound);
  const gpu::ShadowBatch batch{
      .first_view = first_view, .views = count, .casters = static_cast<std::uint32_t>(casters_.casters.size())};
  vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(batch), &batch);
  vkCmdDispatch(recorder.commands(), (batch.casters + CULL_GROUP - 1) / CULL_GROUP,
                (count + views_a_thread - 1) / views_a_thread, 1);
}

}  // namespace lamp::app
