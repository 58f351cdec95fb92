// Draws shadow maps in compute. Why: maps have small triangles and depth alone, a GPU may have few units that rasterize
// (of an H200's 132 multiprocessors a handful draw), and atomics on the atlas's texels need no order.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/shadow_drawing.h"

namespace lamp::app {
namespace {

constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
// Enough to fill any GPU; each goes on to further pairs, items or squares.
constexpr std::uint32_t GROUPS = 16384;
constexpr std::uint32_t CLEAR_GROUPS_A_SQUARE = 16;
constexpr std::uint32_t MOST_GROUPS_Y = 32768;

vulkan::Resource storage(const vulkan::Buffer& buffer) { return vulkan::Resource::storage(buffer.handle()); }

GpuImageInfo float_atlas(std::uint32_t size) {
  return {.name = "shadow atlas",
          .width = size,
          .height = size,
          .format = VK_FORMAT_R32_SFLOAT,
          .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
          .flags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT};
}

class ShadowRasterizer final : public ShadowDrawing {
 public:
  ShadowRasterizer(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowDrawingInfo& info,
                   std::uint32_t most_items);

 private:
  void make_bits(const vulkan::Device& device);
  void make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders);
  [[nodiscard]] vulkan::Resource texels() const;
  void record_start(vulkan::Recorder& recorder, const ShadowJob& job) override;
  void record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                    std::uint32_t count) override;
  void record_group(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view, std::uint32_t group);

  std::uint32_t most_items_ = 0;
  vulkan::OwnedImageView bits_;  ///< the atlas's floats as whole numbers, for atomics
  bool cleared_ = false;         ///< all of the image, once
  vulkan::Buffer draws_;
  vulkan::Buffer group_template_;
  vulkan::Buffer groups_;
  vulkan::Buffer items_;
  vulkan::Buffer squares_;
  vulkan::Pipeline clear_;
  vulkan::Pipeline list_;
  std::array<vulkan::Pipeline, 2> triangles_;  ///< opaque, masked
  std::array<vulkan::Pipeline, 2> blocks_;
};

std::vector<gpu::ShadowGroup> group_data(const ShadowCasters& casters) {
  std::vector<gpu::ShadowGroup> groups;
  for (const ShadowCasters::Group& group : casters.groups) groups.push_back({.first_caster = group.first});
  return groups;
}

ShadowRasterizer::ShadowRasterizer(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                                   const ShadowDrawingInfo& info, std::uint32_t most_items)
    : ShadowDrawing(context, scene, info, float_atlas(info.atlas_size)), most_items_(most_items) {
  const vulkan::Device& device = context.device();
  make_bits(device);
  draws_ =
      upload_buffer(context, "shadow casters' triangles", bytes_of(casters_.draws), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  group_template_ = upload_buffer(context, "shadow groups without pairs", bytes_of(group_data(casters_)),
                                  VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  groups_ = shadow_buffer(device, "shadow groups", casters_.groups.size() * sizeof(gpu::ShadowGroup),
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  items_ =
      shadow_buffer(device, "shadow blocks of triangles", std::uint64_t{most_items} * 2 * sizeof(std::uint32_t), 0);
  squares_ = take(vulkan::Buffer::create(
      device, {.name = "shadow squares to clear",
               .bytes = std::max<std::uint64_t>(1, info.most_squares) * sizeof(gpu::ShadowSquare),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               .memory = vulkan::MemoryUse::upload}));
  make_pipelines(device, shaders);
}

void ShadowRasterizer::make_bits(const vulkan::Device& device) {
  const VkImageViewCreateInfo create{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = atlas_.handle(),
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = VK_FORMAT_R32_UINT,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device.handle, &create, nullptr, &view), "shadow atlas's bits");
  bits_ = vulkan::OwnedImageView(device.handle, view, vkDestroyImageView);
}

void ShadowRasterizer::make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders) {
  const auto make = [&](const char* name, vulkan::PipelineInfo info, std::initializer_list<std::uint32_t> buffers) {
    info.name = name;
    for (const std::uint32_t binding : buffers) info.bindings.push_back({binding});
    return take(vulkan::Pipeline::compute(device, info, shaders.spirv(name)));
  };
  clear_ =
      make("shadow_clear",
           {.bindings = {{1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}}, .push_constant_bytes = sizeof(std::uint32_t)}, {0});
  list_ = pair_pipeline(device, shaders, "shadow_list", {3}, {{0, views_a_batch_}});
  for (std::uint32_t masked = 0; masked < 2; ++masked) {
    const vulkan::PipelineInfo info{.constants = {{0, views_a_batch_}, {1, masked}},
                                    .bindings = {{0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                                                 {1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                                                 {5, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}},
                                    .push_constant_bytes = sizeof(gpu::ShadowRasterBatch)};
    triangles_[masked] = make("shadow_triangles", info, {2, 3, 4, 6, 10, 11, 12, 13, 14, 15});
    blocks_[masked] = make("shadow_blocks", info, {2, 3, 6, 10, 11, 12, 13, 14, 15});
  }
}

vulkan::Resource ShadowRasterizer::texels() const {
  vulkan::Resource resource = atlas_.storage();
  resource.view = bits_.get();
  return resource;
}

void ShadowRasterizer::record_start(vulkan::Recorder& recorder, const ShadowJob& job) {
  std::span<const ShadowSquare> squares = job.squares;
  const ShadowSquare whole{.corner = {0, 0}, .side = atlas_.info().width};
  if (!std::exchange(cleared_, true)) squares = {&whole, 1};
  if (squares.empty()) return;
  static_assert(sizeof(ShadowSquare) == sizeof(gpu::ShadowSquare));
  std::memcpy(squares_.mapped().data(), squares.data(), squares.size_bytes());
  vulkan::Use overwrites = changes(texels());
  overwrites.discard = squares.data() == &whole;
  recorder.barrier({reads(storage(squares_), COMPUTE), overwrites});
  const std::vector<vulkan::Bound> bound{{0, storage(squares_)}, {1, texels()}};
  recorder.bind(clear_, bound);
  const auto count = static_cast<std::uint32_t>(squares.size());
  vkCmdPushConstants(recorder.commands(), clear_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(count), &count);
  vkCmdDispatch(recorder.commands(), CLEAR_GROUPS_A_SQUARE, std::min(count, MOST_GROUPS_Y), 1);
}

void ShadowRasterizer::record_batch(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                                    std::uint32_t count) {
  recorder.barrier({copies_to(storage(groups_))});
  const VkBufferCopy all{.size = groups_.bytes()};
  vkCmdCopyBuffer(recorder.commands(), group_template_.handle(), groups_.handle(), 1, &all);
  recorder.barrier({changes(storage(groups_))});
  const vulkan::Bound groups{3, storage(groups_)};
  record_pairs(recorder, list_, {&groups, 1}, job, first_view, count, 1);
  for (std::uint32_t group = 0; group < casters_.groups.size(); ++group) record_group(recorder, job, first_view, group);
}

void ShadowRasterizer::record_group(vulkan::Recorder& recorder, const ShadowJob& job, std::uint32_t first_view,
                                    std::uint32_t group) {
  const bool masked = casters_.groups[group].masked;
  std::vector<vulkan::Bound> bound{{0, texels()},         {2, scene_.instances()}, {3, storage(groups_)},
                                   {6, storage(items_)},  {10, job.views},         {11, storage(caster_buffer_)},
                                   {12, job.maps},        {13, storage(draws_)},   {14, scene_.vertices()},
                                   {15, scene_.indices()}};
  // Opaque ones bind what they do not read.
  for (const vulkan::Bound& of_material : scene_.material_bound(casters_.groups[group].material))
    if (of_material.binding == 1 || of_material.binding == 5) bound.push_back(of_material);
  const gpu::ShadowRasterBatch batch{.first_view = first_view, .group = group, .most_items = most_items_};
  const auto dispatch = [&](const vulkan::Pipeline& pipeline) {
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(batch), &batch);
    vkCmdDispatch(recorder.commands(), GROUPS, 1, 1);
  };
  recorder.barrier({changes(storage(groups_)), changes(storage(items_)), changes(texels()),
                    reads(storage(pairs_), COMPUTE), reads(job.views, COMPUTE), reads(job.maps, COMPUTE)});
  bound.push_back({4, storage(pairs_)});
  dispatch(triangles_[masked ? 1 : 0]);
  bound.pop_back();
  // Texels are changed by atomics, in any order.
  recorder.barrier({reads(storage(groups_), COMPUTE), reads(storage(items_), COMPUTE), changes(texels())});
  dispatch(blocks_[masked ? 1 : 0]);
}

}  // namespace

std::unique_ptr<ShadowDrawing> shadow_rasterizer(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                                                 const ShadowDrawingInfo& info, std::uint32_t most_items) {
  return std::make_unique<ShadowRasterizer>(context, shaders, scene, info, most_items);
}

}  // namespace lamp::app
