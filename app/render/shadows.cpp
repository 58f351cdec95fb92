// Records shadow maps.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/mesh_pass.h"

namespace lamp::app {
namespace {

// Pairs of caster and view that a batch has room for: 16 MiB. With more views than that there is a further batch, so
// nothing is lost whatever a scene has.
constexpr std::uint32_t BATCH_PAIRS = 1U << 22;
constexpr std::uint32_t MOST_BATCH_VIEWS = 32768;  // group counts along y have at least 16 bits
constexpr std::uint32_t CULL_GROUP = 64;
constexpr std::uint32_t BINDING_VIEWS = 10;
constexpr std::uint32_t BINDING_CASTERS = 11;
constexpr std::uint32_t BINDING_PAIRS = 12;

ShadowAtlas make_atlas(const vulkan::Device& device, const ShadowSettings& settings, std::uint32_t lights) {
  return take(ShadowAtlas::create({.size = settings.atlas_size,
                                   .max_image_size = device.traits.max_image_size,
                                   .light_capacity = std::max(1U, lights),
                                   .points = settings.points,
                                   .filter = settings.filter,
                                   .texels_per_pixel = settings.texels_per_pixel}));
}

void check_features(const Context& context) {
  VkPhysicalDeviceFeatures has{};
  vkGetPhysicalDeviceFeatures(context.device().physical, &has);
  const auto need = [&](VkBool32 feature, const char* name) {
    if (feature == VK_FALSE)
      throw Error(fmt::format("--shadows: device {} lacks the feature {}", context.row().name, name), Exit::no_device);
  };
  need(has.shaderClipDistance, "shaderClipDistance");
  need(has.multiDrawIndirect, "multiDrawIndirect");
  need(has.drawIndirectFirstInstance, "drawIndirectFirstInstance");
}

vulkan::Buffer device_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes,
                             VkBufferUsageFlags usage) {
  return take(vulkan::Buffer::create(device, {.name = name,
                                              .bytes = std::max<std::uint64_t>(bytes, 16),
                                              .usage = usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}));
}

std::uint32_t squares_of(const shared::ShadowMap& map) {
  return map.kind == shared::SHADOW_FACES ? shared::SQUARES_A_LIGHT : 1;
}

VkClearRect clear_rect(const shared::ShadowMap& map, std::uint32_t square) {
  const std::uint32_t at = map.squares[square];
  return {.rect = {.offset = {static_cast<std::int32_t>((at & 0xffffU) * shared::LEAST_SQUARE),
                              static_cast<std::int32_t>((at >> 16U) * shared::LEAST_SQUARE)},
                   .extent = {map.side, map.side}},
          .layerCount = 1};
}

vulkan::Use transfer_writes(const vulkan::Buffer& buffer) {
  return copies_to(vulkan::Resource::storage(buffer.handle()));
}

}  // namespace

Shadows::Shadows(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowSettings& settings,
                 std::uint32_t light_capacity)
    : settings_(settings),
      device_(context.device()),
      shaders_(shaders),
      scene_(scene),
      light_capacity_(light_capacity),
      casters_(shadow_casters(scene)),
      schedule_(make_atlas(context.device(), settings, std::min(light_capacity, settings.lights))),
      radial_(context.device(), shaders, ShadowReach::Kind::radial, settings.filter, light_capacity) {
  check_features(context);
  const vulkan::Device& device = context.device();
  const auto casters = static_cast<std::uint32_t>(casters_.casters.size());
  const std::uint64_t views = std::uint64_t{std::min(light_capacity, settings.lights)} * shared::VIEWS_A_LIGHT;
  views_a_batch_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
      std::min<std::uint64_t>(BATCH_PAIRS / std::max(1U, casters), views), 1, MOST_BATCH_VIEWS));
  for (std::uint32_t i = 0; i < casters; ++i) casters_.draws[i].first_instance = i * views_a_batch_;

  atlas_ = GpuImage(device, {.name = "shadow atlas",
                             .width = settings.atlas_size,
                             .height = settings.atlas_size,
                             .format = VK_FORMAT_D32_SFLOAT,
                             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  caster_buffer_ =
      upload_buffer(context, "shadow casters", bytes_of(casters_.casters), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  draw_template_ =
      upload_buffer(context, "shadow draws without views", bytes_of(casters_.draws), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  draws_ = device_buffer(device, "shadow draws", casters_.draws.size() * sizeof(gpu::ShadowDraw),
                         VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  pairs_ = device_buffer(device, "shadow pairs", std::uint64_t{casters} * views_a_batch_ * sizeof(std::uint32_t), 0);
  const std::uint64_t map_bytes = std::max<std::uint64_t>(1, light_capacity) * sizeof(shared::ShadowMap);
  const std::uint64_t view_bytes = views * sizeof(shared::ShadowView);
  views_ = device_buffer(device, "shadow views", view_bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  map_buffer_ = device_buffer(device, "shadow maps", map_bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  staging_ = take(vulkan::Buffer::create(device, {.name = "shadow staging",
                                                  .bytes = map_buffer_.bytes() + views_.bytes(),
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                  .memory = vulkan::MemoryUse::upload}));
  if (ShadowMoments::has(settings.filter))
    moments_.emplace(context, shaders, settings.filter, settings.atlas_size,
                     std::uint64_t{settings.atlas_size} * settings.atlas_size);
  make_pipelines(device, shaders);
}

void Shadows::make_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders) {
  const std::vector<vulkan::Constant> constants{{0, views_a_batch_}};
  vulkan::PipelineInfo cull{
      .name = "shadow cull", .constants = constants, .push_constant_bytes = sizeof(gpu::ShadowBatch)};
  for (std::uint32_t i = 0; i < 5; ++i) cull.bindings.push_back({i});
  cull_ = take(vulkan::Pipeline::compute(device, cull, shaders.spirv("shadow_cull")));

  vulkan::GraphicsState state = mesh_state(VK_COMPARE_OP_GREATER, {});
  std::erase_if(state.attributes,
                [](const auto& attribute) { return attribute.location == 1 || attribute.location == 2; });
  state.dynamic_cull = false;  // both sides: what is closed casts the same, what is a sheet is seen from both
  state.depth_clamp = true;
  vulkan::PipelineInfo draw{.name = "shadow maps, opaque", .constants = constants};
  for (const std::uint32_t binding : {2U, BINDING_VIEWS, BINDING_CASTERS, BINDING_PAIRS})
    draw.bindings.push_back({binding});
  opaque_ = take(vulkan::Pipeline::graphics(device, draw, shaders.spirv("shadow"), {}, state));
  draw.name = "shadow maps, masked";
  draw.bindings.push_back({1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER});
  for (std::uint32_t i = 5; i < 10; ++i) draw.bindings.push_back({i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER});
  masked_ = take(vulkan::Pipeline::graphics(device, draw, shaders.spirv("shadow"), shaders.spirv("depth"), state));
}

void Shadows::schedule(std::span<const View> views, std::span<const shared::Light> lights) {
  const auto shadowed = lights.first(std::min<std::size_t>(lights.size(), settings_.lights));
  if (std::exchange(changed_, true)) schedule_.redraw_all();  // nobody drew the last one
  const ShadowFrame frame = take(schedule_.schedule(
      {.views = views, .lights = shadowed, .moved = moved_, .budget_texels = settings_.budget_texels}));
  moved_.clear();
  counts_ = frame.counts;
  waiting_.assign(frame.waiting.begin(), frame.waiting.end());
  without_.assign(frame.without.begin(), frame.without.end());
  maps_.assign(frame.maps.begin(), frame.maps.end());
  maps_.resize(lights.size());
  ages_.resize(lights.size());
  for (std::uint32_t& age : ages_) ++age;
  for (const ShadowRedraw& redraw : frame.redraws) ages_[redraw.light] = 0;
  view_count_ = static_cast<std::uint32_t>(frame.views.size());
  clears_.clear();
  for (const ShadowRedraw& redraw : frame.redraws)
    for (std::uint32_t i = 0; i < squares_of(maps_[redraw.light]); ++i)
      clears_.push_back(clear_rect(maps_[redraw.light], i));
  if (moments_) moments_->set(maps_, frame.redraws);
  lights_.assign(lights.begin(), lights.end());
  radial_.set(maps_, lights, frame.redraws);
  if (meshes_) meshes_->set(maps_, lights, frame.redraws);
  const std::span<std::byte> to = staging_.mapped();
  if (!maps_.empty()) std::memcpy(to.data(), maps_.data(), maps_.size() * sizeof(shared::ShadowMap));
  if (view_count_ != 0)
    std::memcpy(to.subspan(map_buffer_.bytes()).data(), frame.views.data(), frame.views.size_bytes());
}

void Shadows::record(vulkan::Recorder& recorder) {
  if (!std::exchange(changed_, false)) return;
  recorder.begin_pass("shadow maps", {});
  record_uploads(recorder);
  record_clears(recorder);
  cleared_ = true;
  for (std::uint32_t at = 0; at < view_count_ && !casters_.casters.empty(); at += views_a_batch_)
    record_batch(recorder, at, std::min(views_a_batch_, view_count_ - at));
  const vulkan::Resource maps = vulkan::Resource::storage(map_buffer_.handle());
  if (moments_) moments_->record(recorder, maps, atlas_);
  radial_.record(recorder, maps, atlas_);
  recorder.end_pass();
}

void Shadows::need_meshes() {
  if (meshes_) return;
  meshes_.emplace(device_, shaders_, ShadowReach::Kind::meshes, settings_.filter, light_capacity_);
  meshes_->set(maps_, lights_, {});
}

void Shadows::record_meshes(vulkan::Recorder& recorder) {
  if (!meshes_) return;
  record(recorder);
  recorder.begin_pass("light meshes", {});
  meshes_->record(recorder, vulkan::Resource::storage(map_buffer_.handle()), atlas_);
  recorder.end_pass();
}

void Shadows::record_uploads(vulkan::Recorder& recorder) {
  recorder.barrier({transfer_writes(map_buffer_), transfer_writes(views_)});
  const auto copy = [&](const vulkan::Buffer& to, std::uint64_t from, std::uint64_t bytes) {
    const VkBufferCopy part{.srcOffset = from, .size = bytes};
    if (bytes != 0) vkCmdCopyBuffer(recorder.commands(), staging_.handle(), to.handle(), 1, &part);
  };
  copy(map_buffer_, 0, maps_.size() * sizeof(shared::ShadowMap));
  copy(views_, map_buffer_.bytes(), view_count_ * sizeof(shared::ShadowView));
}

void Shadows::begin_atlas(VkCommandBuffer commands) const {
  const VkRect2D area{.extent = {settings_.atlas_size, settings_.atlas_size}};
  const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = atlas_.view(),
                                        .imageLayout = atlas_.attachment().layout,
                                        .loadOp = cleared_ ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRenderingInfo info{
      .sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = area, .layerCount = 1, .pDepthAttachment = &depth};
  vkCmdBeginRendering(commands, &info);
  const auto side = static_cast<float>(settings_.atlas_size);
  const VkViewport viewport{.width = side, .height = side, .maxDepth = 1.0F};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
}

void Shadows::record_clears(vulkan::Recorder& recorder) const {
  if (cleared_ && clears_.empty()) return;
  recorder.barrier({draws_depth(atlas_, cleared_ ? Load::keep : Load::clear)});
  begin_atlas(recorder.commands());
  const VkClearAttachment far_away{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT};
  if (cleared_)
    vkCmdClearAttachments(recorder.commands(), 1, &far_away, static_cast<std::uint32_t>(clears_.size()),
                          clears_.data());
  vkCmdEndRendering(recorder.commands());
}

void Shadows::record_batch(vulkan::Recorder& recorder, std::uint32_t first_view, std::uint32_t count) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const auto storage = [](const vulkan::Buffer& buffer) { return vulkan::Resource::storage(buffer.handle()); };
  const auto changes = [&](const vulkan::Buffer& buffer) {
    return vulkan::Use{.resource = storage(buffer),
                       .stages = COMPUTE,
                       .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
  };
  recorder.barrier({transfer_writes(draws_)});
  const VkBufferCopy all{.size = casters_.draws.size() * sizeof(gpu::ShadowDraw)};
  vkCmdCopyBuffer(recorder.commands(), draw_template_.handle(), draws_.handle(), 1, &all);

  recorder.barrier({changes(draws_), changes(pairs_), reads(storage(views_), COMPUTE)});
  const std::vector<vulkan::Bound> bound{{0, storage(views_)},
                                         {1, storage(caster_buffer_)},
                                         {2, scene_.instances()},
                                         {3, storage(draws_)},
                                         {4, storage(pairs_)}};
  recorder.bind(cull_, bound);
  const gpu::ShadowBatch batch{
      .first_view = first_view, .views = count, .casters = static_cast<std::uint32_t>(casters_.casters.size())};
  vkCmdPushConstants(recorder.commands(), cull_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(batch), &batch);
  vkCmdDispatch(recorder.commands(), (batch.casters + CULL_GROUP - 1) / CULL_GROUP, count, 1);

  recorder.barrier({{.resource = storage(draws_),
                     .stages = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                     .access = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT},
                    reads(storage(pairs_), GRAPHICS_SHADERS),
                    reads(storage(views_), GRAPHICS_SHADERS),
                    draws_depth(atlas_, Load::keep)});
  begin_atlas(recorder.commands());
  record_draws(recorder);
  vkCmdEndRendering(recorder.commands());
}

void Shadows::record_draws(vulkan::Recorder& recorder) const {
  scene_.bind_geometry(recorder.commands());
  const std::vector<vulkan::Bound> shared_bound{{2, scene_.instances()},
                                                {BINDING_VIEWS, vulkan::Resource::storage(views_.handle())},
                                                {BINDING_CASTERS, vulkan::Resource::storage(caster_buffer_.handle())},
                                                {BINDING_PAIRS, vulkan::Resource::storage(pairs_.handle())}};
  for (const ShadowCasters::Group& group : casters_.groups) {
    std::vector<vulkan::Bound> bound = shared_bound;
    if (group.masked) {
      const auto of_material = scene_.material_bound(group.material);
      bound.insert(bound.end(), of_material.begin(), of_material.end());
    }
    recorder.bind(group.masked ? masked_ : opaque_, bound);
    vkCmdDrawIndexedIndirect(recorder.commands(), draws_.handle(), group.first * sizeof(gpu::ShadowDraw), group.count,
                             sizeof(gpu::ShadowDraw));
  }
}

}  // namespace lamp::app
