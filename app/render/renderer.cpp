// Submits frames and reads them back.
// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <ranges>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/antialias.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t MAX_PASSES = 64;  // of a view

std::unique_ptr<Targets> make_targets(const vulkan::Device& device, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t limit = device.traits.max_image_size;
  if (width == 0 || height == 0 || width > limit || height > limit)
    throw Error(fmt::format("size {}x{}: expected 1 to {} pixels a side on this device", width, height, limit));
  try {
    return std::make_unique<Targets>(device, width, height);
  } catch (const Error& error) {
    throw Error(fmt::format("size {}x{}: {}; expected a smaller picture", width, height, error.what()), error.exit());
  }
}

void add_counts(Rendered& rendered, const Lighting& lighting) {
  vulkan::FrameCounts counted = lighting.counts();
  rendered.counters = counted.counters;
  rendered.needed = std::move(counted.needed);
  rendered.any_depth = lighting.any_depth_counts();
}

}  // namespace

Renderer::Renderer(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, std::uint32_t width,
                   std::uint32_t height, std::uint32_t light_capacity, std::uint32_t decal_capacity,
                   const HostDepth& depth)
    : context_(context),
      shaders_(shaders),
      scene_(scene),
      depth_(depth),
      targets_(make_targets(context.device(), width, height)),
      data_(context.device(), light_capacity, decal_capacity),
      geometry_(context.device(), shaders, depth),
      no_shadows_(context.device()),
      no_captures_(std::make_unique<ProbeAtlas>(context, shaders, 0)),
      no_probes_(context, *no_captures_),
      no_still_(context),
      light_capacity_(light_capacity),
      decal_capacity_(decal_capacity),
      timestamps_(take(vulkan::Timestamps::create(context.device(), MAX_PASSES * depth.views))) {
  if (depth.several()) {
    check_depth_samples(context.device(), depth.samples);
    all_pictures_ = AllPictures{.data = FrameData(context.device(), light_capacity, decal_capacity, depth.views)};
    for (std::uint32_t i = 0; i < depth.views; ++i)
      all_pictures_->depths.emplace_back(context.device(), shaders,
                                         SampledDepthInfo{.samples = depth.samples, .width = width, .height = height});
    for (const SampledDepth& of_view : all_pictures_->depths) culled_depths_.push_back(of_view.image().sampled());
  } else {
    culled_depths_.push_back(targets_->depth.sampled());
  }
}

void Renderer::cast_shadows(const ShadowSettings& settings) {
  assert(!shadows_ && "once");
  check_shadow_raster(context_, settings.raster);
  // Where some lights stand still, a box's number is between those of two lights.
  const auto boxes = static_cast<std::uint32_t>(decal_capacity_ + probes().probes().size());
  shadows_.emplace(context_, shaders_, scene_, settings, light_capacity_, boxes);
}

void Renderer::light_probes(const ProbeSet* set) {
  assert(!shadows_ && !mirror_ && "before cast_shadows and mirror");
  probes_ = set;
  const std::uint32_t records = light_capacity_ + static_cast<std::uint32_t>(probes().probes().size());
  data_ = FrameData(context_.device(), records, decal_capacity_);
  tracker_ = {};
  for (const vulkan::Bound& bound : probes().bound()) tracker_.assume(bound.resource);  // captures are kept
  views_.clear();
  forget_surfaces();
  if (all_pictures_) all_pictures_->data = FrameData(context_.device(), records, decal_capacity_, depth_.views);
}

void Renderer::mirror(const MirrorSettings& settings) {
  assert(!mirror_ && "once");
  const auto boxes = static_cast<std::uint32_t>(decal_capacity_ + probes().probes().size());
  mirror_.emplace(context_, shaders_, scene_,
                  MirrorInfo{.settings = settings,
                             .width = targets_->width,
                             .height = targets_->height,
                             .light_capacity = light_capacity_ + boxes,
                             .shadows = shadows_ ? std::optional(shadows_->settings().filter) : std::nullopt});
}

void Renderer::set_frame(std::span<const View> views, std::span<const shared::Light> lights,
                         std::span<const gpu::DecalData> decals) {
  set_views(views, lights, decals);
  if (!shadows_) return;
  if (still_ != nullptr && still_->lights() != 0)
    shadows_->schedule(views_, data_.records(), entities().boxes);
  else
    shadows_->schedule(views_, lights);
}

void Renderer::set_views(std::span<const View> views, std::span<const shared::Light> lights,
                         std::span<const gpu::DecalData> decals) {
  assert(views.size() == depth_.views && "make a Renderer for another number of views");
  assert(views.front().reversed_depth() == depth_.reversed && "make a Renderer for the other direction");
  const bool moves = !std::ranges::equal(views, views_);
  views_.assign(views.begin(), views.end());
  mover_ = nullptr;
  if (moves || all_pictures_) forget_surfaces();
  shown_ = {};
  shown_view_ = views_.front();
  const std::uint32_t still = still_ == nullptr ? 0 : still_->lights();
  data_.set({&shown_view_, 1}, lights, decals, still, probes().probes());
  if (!all_pictures_) return;
  all_pictures_->data.set(views_, lights, decals, still, probes().probes());
  if (moves) draw_depths();
  show({});
}

void Renderer::show(const FramePicture& shown) {
  if (!all_pictures_) return;
  forget_surfaces();
  shown_ = shown;
  shown_view_ = views_[shown.view];
  if (depth_.samples > 1) shown_view_ = shifted(shown_view_, sample_places(depth_.samples)[shown.sample] - 0.5);
  data_.set_view(shown_view_, shown.view);
}

std::vector<FramePicture> Renderer::all_pictures() const {
  std::vector<FramePicture> all;
  for (std::uint32_t view = depth_.views; view-- != 0;)
    for (std::uint32_t sample = depth_.samples; sample-- != 0;) all.push_back({view, sample});
  return all;
}

void Renderer::draw_depths() {
  const std::vector<FramePicture> all = all_pictures();
  for (const FramePicture& shown : all | std::views::reverse) {  // a view's first sample clears its others
    show(shown);
    submit(nullptr, [&](VkCommandBuffer commands) {
      vulkan::Recorder recorder(context_.device(), commands, tracker_);
      record_upload(recorder);
      geometry_.record_depth(recorder, scene_, data_, *targets_);
      all_pictures_->depths[shown.view].record(recorder, targets_->depth, shown.sample);
    });
  }
}

vulkan::PlanInputs Renderer::plan_inputs() const {
  vulkan::PlanInputs inputs = culled_data().plan_inputs(culled_depths_);
  if (!shadows_) return inputs;
  if (const vulkan::Buffer* radial = shadows_->reach(ShadowReach::Kind::radial)) inputs.radial = radial->handle();
  if (const vulkan::Buffer* meshes = shadows_->reach(ShadowReach::Kind::meshes)) inputs.meshes = meshes->handle();
  return inputs;
}

void Renderer::record_upload(vulkan::Recorder& recorder) {
  data_.record_upload(recorder);
  if (const LightMover* mover = std::exchange(mover_, nullptr)) mover->record(recorder, data_, time_);
  if (all_pictures_) all_pictures_->data.record_upload(recorder);
}

void Renderer::record_reach(vulkan::Recorder& recorder, const Lighting& lighting) {
  const Plan& plan = lighting.runner().plan();
  if (!shadows_ || !(plan.binds(INPUT_RADIAL) || plan.binds(INPUT_MESHES))) return;
  if (plan.binds(INPUT_RADIAL)) shadows_->need(ShadowReach::Kind::radial);
  if (plan.binds(INPUT_MESHES)) shadows_->need(ShadowReach::Kind::meshes);
  shadows_->record_reach(recorder);
}

LightingFrame Renderer::lighting_frame() const {
  return {.scene = scene_,
          .data = data_,
          .targets = *targets_,
          .geometry = geometry_,
          .inputs = plan_inputs(),
          .view = shown_.view,
          .kept = kept_ ? &*kept_ : nullptr,
          .views = all_pictures_ ? std::span<const View>(views_) : std::span<const View>(&shown_view_, 1),
          .eye = glm::vec3(glm::dmat4(shown_view_.world_from_view())[3]),
          .shadows = shadow_bound(),
          .still = (still_ == nullptr ? no_still_ : *still_).words(),
          .mirror = nullptr,
          .probes = probes().bound()};
}

void Renderer::submit(Lighting* lighting, const std::function<void(VkCommandBuffer)>& record) {
  if (lighting != nullptr) {
    const Plan& plan = lighting->runner().plan();
    still_tree_.bring(context_, culled_data(), plan, lighting->info().options);
    culled_data().take_cells_of(plan);
  }
  context_.submit(record);
  if (lighting != nullptr) lighting->finish();
  if (mirror_) mirror_->finish();
}

void Renderer::record_frame(vulkan::Recorder& recorder, Lighting& lighting, bool relights) {
  record_upload(recorder);
  if (shadows_) shadows_->record(recorder);
  record_reach(recorder, lighting);
  LightingFrame frame = lighting_frame();
  frame.surfaces_drawn = relights && surfaces_drawn_;
  if (mirror_) frame.mirror = &*mirror_;
  lighting.record(recorder, frame);
  // Forward paths leave the G-buffer as it was, decals are painted into it.
  if (lighting.info().path != ShadingPath::forward) surfaces_drawn_ = !lighting.info().decals;
}

Rendered Renderer::render(Lighting& lighting, std::uint32_t frames, std::uint32_t warm_up) {
  return render_frames(lighting, frames, warm_up, false);
}

Rendered Renderer::relight(Lighting& lighting) { return render_frames(lighting, 1, 0, true); }

Rendered Renderer::render_frames(Lighting& lighting, std::uint32_t frames, std::uint32_t warm_up, bool relights) {
  const std::size_t pixels = std::size_t{targets_->width} * targets_->height;
  const vulkan::Buffer picture = readback_buffer(context_.device(), "picture read-back", pixels * sizeof(glm::vec4));
  FrameTimes times(frames);
  const Shadows::Pending pending = pending_shadows();
  for (std::uint32_t i = 0; i < frames + warm_up; ++i) {
    if (i == warm_up) set_pending_shadows(pending);
    const bool last = i + 1 == frames + warm_up;
    const Timing timing = i >= warm_up ? times.next() : Timing::passes;
    submit(&lighting, [&](VkCommandBuffer commands) {
      timestamps_.reset(commands, parts_of(lighting, timing));
      vulkan::Recorder recorder(context_.device(), commands, tracker_, &timestamps_);
      record_frame(recorder, lighting, relights);
      timestamps_.finish(commands);
      if (!last) return;
      record_readback(recorder, targets_->hdr, picture);
      lighting.record_counts(recorder);
      if (mirror_) mirror_->record_counts(recorder);
    });
    if (i >= warm_up) times.add(timestamps_.read(), lighting);
  }
  tracker_.forget(picture.handle());
  Rendered rendered{.image = {targets_->width, targets_->height, first_values<glm::vec4>(picture, pixels)}};
  times.fill(rendered, lighting);
  add_counts(rendered, lighting);
  return rendered;
}

Rendered Renderer::draw(Lighting& lighting, const std::function<void(vulkan::Recorder&)>& more) {
  FrameTimes times;
  submit(&lighting, [&](VkCommandBuffer commands) {
    timestamps_.reset(commands);
    vulkan::Recorder recorder(context_.device(), commands, tracker_, &timestamps_);
    record_frame(recorder, lighting, true);
    timestamps_.finish(commands);
    vulkan::Recorder untimed(context_.device(), commands, tracker_);
    more(untimed);
    lighting.record_counts(untimed);
  });
  times.add(timestamps_.read(), lighting);
  Rendered rendered;
  times.fill(rendered, lighting);
  add_counts(rendered, lighting);
  return rendered;
}

void Renderer::also(const std::function<void(vulkan::Recorder&)>& record) {
  submit(nullptr, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record(recorder);
  });
}

vulkan::FrameCounts Renderer::cull(Lighting& lighting) {
  if (lighting.runner().plan().counters == NO_RESOURCE && lighting.any_depth_method() == nullptr) return {};
  need_surfaces();
  submit(&lighting, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record_upload(recorder);
    record_reach(recorder, lighting);
    lighting.record_cull(recorder, lighting_frame());
    lighting.record_any_depth_cull(recorder, lighting_frame());
    lighting.record_counts(recorder);
  });
  return lighting.counts();
}

void Renderer::cull_as(Lighting& lighting, const View& other) {
  assert(!all_pictures_ && "of one view, with one sample a pixel");
  const View shown = std::exchange(shown_view_, other);
  data_.set_view(other);
  submit(&lighting, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record_upload(recorder);
    record_reach(recorder, lighting);
    lighting.record_cull(recorder, lighting_frame());
  });
  shown_view_ = shown;
  data_.set_view(shown);
}

void Renderer::wake(Lighting& lighting) {
  constexpr double LONG_WAIT_MS = 5.0;
  // The longer a GPU waits, the deeper it sleeps: an H200 that waited for seconds is at a sixth of its clock, and 50 ms
  // of work do not wake it.
  constexpr double LEAST_WAKE_MS = 50.0;
  constexpr double MOST_WAKE_MS = 1000.0;
  const double waited_ms = context_.idle_ms();
  if (context_.software() || waited_ms < LONG_WAIT_MS) return;
  const double enough_ms = std::clamp(waited_ms, LEAST_WAKE_MS, MOST_WAKE_MS);
  const Shadows::Pending pending = pending_shadows();
  for (double ms = 0.0; ms < enough_ms;) ms += span_ms(time_frame(lighting, Timing::parts));
  set_pending_shadows(pending);
}

std::vector<vulkan::Timestamps::Time> Renderer::time(Lighting& lighting, Timing timing) {
  wake(lighting);
  return time_frame(lighting, timing);
}

std::vector<vulkan::Timestamps::Time> Renderer::time_frame(Lighting& lighting, Timing timing) {
  submit(&lighting, [&](VkCommandBuffer commands) {
    timestamps_.reset(commands, parts_of(lighting, timing));
    vulkan::Recorder recorder(context_.device(), commands, tracker_, &timestamps_);
    record_frame(recorder, lighting, false);
    timestamps_.finish(commands);
  });
  return timestamps_.read();
}

void Renderer::warm_up(Lighting& lighting) {
  submit(&lighting, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record_frame(recorder, lighting, true);
  });
}

}  // namespace lamp::app
