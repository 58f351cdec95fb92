// Records shadow maps.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "gpu/check.h"

namespace lamp::app {
namespace {

ShadowAtlas make_atlas(const vulkan::Device& device, const ShadowSettings& settings, std::uint32_t lights) {
  return take(ShadowAtlas::create({.size = settings.atlas_size,
                                   .max_image_size = device.traits.max_image_size,
                                   .light_capacity = std::max(1U, lights),
                                   .points = settings.points,
                                   .filter = settings.filter,
                                   .texels_per_pixel = settings.texels_per_pixel}));
}

bool ends_loops(const vulkan::Device& device) { return device.traits.max_loop_rounds != ~0U; }

std::unique_ptr<ShadowDrawing> make_drawing(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                                            const ShadowSettings& settings, std::uint64_t lights) {
  const ShadowDrawingInfo info{.atlas_size = settings.atlas_size,
                               .most_views = lights * shared::VIEWS_A_LIGHT,
                               .most_squares = lights * shared::SQUARES_A_LIGHT};
  const bool compute = settings.raster == ShadowRaster::compute ||
                       (settings.raster == ShadowRaster::automatic && !ends_loops(context.device()));
  return compute ? shadow_rasterizer(context, shaders, scene, info, settings.raster_items)
                 : shadow_draws(context, shaders, scene, info);
}

vulkan::Use transfer_writes(const vulkan::Buffer& buffer) {
  return copies_to(vulkan::Resource::storage(buffer.handle()));
}

}  // namespace

void check_shadow_raster(const Context& context, ShadowRaster raster) {
  if (raster != ShadowRaster::compute || !ends_loops(context.device())) return;
  throw Error(
      fmt::format(
          "--shadow-raster compute: device {} ends a shader's loops after {} rounds, and triangles might be lost; "
          "expected hardware or auto",
          context.row().name, context.device().traits.max_loop_rounds),
      Exit::no_device);
}

Shadows::Shadows(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, const ShadowSettings& settings,
                 std::uint32_t light_capacity, std::uint32_t box_capacity)
    : settings_(settings),
      device_(context.device()),
      shaders_(shaders),
      light_capacity_(light_capacity),
      box_capacity_(box_capacity),
      schedule_(make_atlas(context.device(), settings, casting_capacity())),
      drawing_(make_drawing(context, shaders, scene, settings, casting_capacity())) {
  const vulkan::Device& device = context.device();
  const std::uint64_t views = std::uint64_t{casting_capacity()} * shared::VIEWS_A_LIGHT;
  const std::uint64_t map_bytes =
      std::max<std::uint64_t>(1, std::uint64_t{light_capacity} + box_capacity) * sizeof(shared::ShadowMap);
  views_ = shadow_buffer(device, "shadow views", views * sizeof(shared::ShadowView), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  map_buffer_ = shadow_buffer(device, "shadow maps", map_bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  staging_ = take(vulkan::Buffer::create(device, {.name = "shadow staging",
                                                  .bytes = map_buffer_.bytes() + views_.bytes(),
                                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                  .memory = vulkan::MemoryUse::upload}));
  if (ShadowMoments::has(settings.filter))
    moments_.emplace(context, shaders, settings.filter, settings.blur, settings.atlas_size);
}

std::uint32_t Shadows::casting_capacity() const { return std::min(light_capacity_, settings_.lights) + box_capacity_; }

void Shadows::restart() {
  schedule_ = make_atlas(device_, settings_, casting_capacity());
  moved_.clear();
  ages_.clear();
  changed_ = false;
}

void Shadows::schedule(std::span<const View> views, std::span<const shared::Light> records, EntityRange boxes) {
  boxes_ = boxes;
  records_.assign(records.begin(), records.end());
  for (std::uint32_t i = boxes.first; i < boxes.end; ++i) records_[i].range = 0.0F;  // no shadow
  const std::size_t casting =
      settings_.lights > boxes.first ? std::size_t{settings_.lights} + boxes.count() : std::size_t{settings_.lights};
  const std::span<const shared::Light> shadowed = std::span(records_).first(std::min(records.size(), casting));
  if (std::exchange(changed_, true)) schedule_.redraw_all();  // nobody drew the last one
  const ShadowFrame frame = take(schedule_.schedule(
      {.views = views, .lights = shadowed, .moved = moved_, .budget_texels = settings_.budget_texels}));
  moved_.clear();
  counts_ = frame.counts;
  waiting_.assign(frame.waiting.begin(), frame.waiting.end());
  without_.assign(frame.without.begin(), frame.without.end());
  maps_.assign(frame.maps.begin(), frame.maps.end());
  maps_.resize(records.size());
  ages_.resize(records.size());
  for (std::uint32_t& age : ages_) ++age;
  for (const ShadowRedraw& redraw : frame.redraws) ages_[redraw.light] = 0;
  redrawn_squares_.assign(frame.squares.begin(), frame.squares.end());
  host_views_.assign(frame.views.begin(), frame.views.end());
  viewports_.clear();
  for (const shared::ShadowView& view : host_views_) viewports_.push_back(shadow_viewport(maps_[view.light], view));
  if (moments_) moments_->set(maps_, frame.redraws);
  if (bounds_lights())
    for (std::optional<ShadowReach>& reach : reaches_)
      if (reach) reach->add(frame.radial_jobs);
  const std::span<std::byte> to = staging_.mapped();
  if (!maps_.empty()) std::memcpy(to.data(), maps_.data(), maps_.size() * sizeof(shared::ShadowMap));
  if (!host_views_.empty())
    std::memcpy(to.subspan(map_buffer_.bytes()).data(), host_views_.data(), frame.views.size_bytes());
}

void Shadows::record(vulkan::Recorder& recorder) {
  if (!std::exchange(changed_, false)) return;
  recorder.begin_pass("shadow maps", {});
  record_uploads(recorder);
  const vulkan::Resource maps = vulkan::Resource::storage(map_buffer_.handle());
  drawing_->record(recorder, {.views = vulkan::Resource::storage(views_.handle()),
                              .maps = maps,
                              .squares = redrawn_squares_,
                              .host_views = host_views_,
                              .viewports = viewports_});
  recorder.end_pass();
  if (moments_) moments_->record(recorder, maps, atlas());
}

Shadows::Pending Shadows::pending() const {
  Pending pending{.maps = changed_};
  for (std::size_t i = 0; i < reaches_.size(); ++i)
    if (reaches_[i]) pending.jobs[i] = reaches_[i]->pending();
  return pending;
}

void Shadows::set_pending(const Pending& pending) {
  changed_ = pending.maps;
  for (std::size_t i = 0; i < reaches_.size(); ++i)
    if (reaches_[i]) reaches_[i]->add(pending.jobs[i]);
}

void Shadows::need(ShadowReach::Kind kind) {
  std::optional<ShadowReach>& reach = reaches_[static_cast<std::size_t>(kind)];
  if (reach) return;
  reach.emplace(device_, shaders_, kind, settings_.filter, light_capacity_ + box_capacity_);
  if (!bounds_lights()) return;
  std::vector<shared::RadialJob> jobs;
  for (std::uint32_t i = 0; i < records_.size(); ++i)
    jobs.push_back({.light = i, .shows_all = shadow_shows_all(maps_[i], records_[i]) ? 1U : 0U});
  reach->add(jobs);
}

void Shadows::record_reach(vulkan::Recorder& recorder) {
  record(recorder);
  for (std::optional<ShadowReach>& reach : reaches_)
    if (reach)
      reach->record(recorder,
                    {.maps = vulkan::Resource::storage(map_buffer_.handle()), .host_maps = maps_, .atlas = atlas()});
}

const vulkan::Buffer* Shadows::reach(ShadowReach::Kind kind) const {
  const std::optional<ShadowReach>& reach = reaches_[static_cast<std::size_t>(kind)];
  return reach ? &reach->buffer() : nullptr;
}

void Shadows::record_uploads(vulkan::Recorder& recorder) {
  recorder.barrier({transfer_writes(map_buffer_), transfer_writes(views_)});
  const auto copy = [&](const vulkan::Buffer& to, std::uint64_t from, std::uint64_t bytes) {
    const VkBufferCopy part{.srcOffset = from, .size = bytes};
    if (bytes != 0) vkCmdCopyBuffer(recorder.commands(), staging_.handle(), to.handle(), 1, &part);
  };
  copy(map_buffer_, 0, maps_.size() * sizeof(shared::ShadowMap));
  copy(views_, map_buffer_.bytes(), host_views_.size() * sizeof(shared::ShadowView));
}

}  // namespace lamp::app
