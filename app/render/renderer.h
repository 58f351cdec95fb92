// Renders a scene with any lighting, reads pictures back, and walks look-ups for heat maps and verification.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "image/image.h"
#include "lamplight/shared/counters.h"
#include "oracle/reference.h"
#include "render/frame_times.h"
#include "render/light_mover.h"
#include "render/lighting.h"
#include "render/mirror_pass.h"
#include "render/probe_set.h"
#include "render/sample_depth.h"
#include "render/still_lists.h"
#include "render/still_tree.h"
#include "render/visit.h"

namespace lamp::app {

/// Times of a pass over all timed frames, milliseconds.
struct PassTime {
  std::string name;
  double ms_median = 0.0;
  double ms_p5 = 0.0;
  double ms_p95 = 0.0;
  bool cull = false;
  bool shade = false;
  bool host = false;                                  ///< on the CPU, before the GPU begins; of no sum
  std::vector<vulkan::PipelineStatistic> statistics;  ///< what the driver says of its pipeline, where it was asked
};

struct Rendered {
  HdrImage image;
  std::vector<PassTime> passes;
  double cull_ms = 0.0;  ///< medians over the frames
  double shade_ms = 0.0;
  double frame_ms = 0.0;
  shared::Counters counters{};        ///< of the last frame
  std::vector<std::uint32_t> needed;  ///< of the plan's capacities, likewise
  vulkan::FrameCounts any_depth;      ///< of the lists that transparent surfaces have of their own, likewise
};

/// A dispatch over the pixels of the last frame, for checks: one thread a pixel.
struct PixelPass {
  std::string_view shader;       ///< compiled with the look-up, where there is a lighting; frame at 0, depth at 1
  Lighting* lighting = nullptr;  ///< whose look-up is walked
  vulkan::PlanRunner::Passes which = vulkan::PlanRunner::Passes::separate;
  bool prepares = true;  ///< uploads frame and lights, and culls the last frame's depth
  struct Storage {
    std::uint32_t binding = 0;
    vulkan::Resource resource;
    VkAccessFlags2 access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    bool zeroed = false;  ///< before the dispatch; the buffer is one that transfers write
  };
  std::vector<Storage> storage;
  std::vector<vulkan::Bound> bound;         ///< that is read besides
  std::vector<vulkan::Constant> constants;  ///< besides those of the look-up
  std::uint32_t group_px = 16;              ///< threads of a group along x and y; a fused look-up's are its tile's
  Rows rows;                                ///< dispatched; 0 rows: all. A fused look-up's are always all
  std::vector<std::uint32_t> push;          ///< constants
};

class Renderer {
 public:
  /// Throws Error when a size is 0 or beyond the device's limits, and where the device has no such depth images.
  Renderer(Context& context, const ShaderLibrary& shaders, const GpuScene& scene, std::uint32_t width,
           std::uint32_t height, std::uint32_t light_capacity, std::uint32_t decal_capacity = 0,
           const HostDepth& depth = {});

  /// Lights of all frames cast shadows. Once, before the first `set_frame`. Throws Error for what the device cannot do.
  void cast_shadows(const ShadowSettings& settings);
  /// The next `set_frame` draws them as if it were the first. Nothing where no light casts one.
  void restart_shadows() {
    if (shadows_) shadows_->restart();
  }
  /// What the next frame draws of the last `set_frame`; given back after it, it is drawn once more: by frames of
  /// several lightings that are timed alike. Nothing where no light casts a shadow.
  [[nodiscard]] Shadows::Pending pending_shadows() const { return shadows_ ? shadows_->pending() : Shadows::Pending{}; }
  void set_pending_shadows(const Shadows::Pending& pending) {
    if (shadows_) shadows_->set_pending(pending);
  }
  /// Null: no light casts a shadow.
  [[nodiscard]] const Shadows* shadows() const { return shadows_ ? &*shadows_ : nullptr; }
  /// Surfaces below a roughness mirror what is around them, in all frames. Once, behind `cast_shadows`. Where there are
  /// probes, for lightings that were made for that roughness. Throws Error for what the device cannot do.
  void mirror(const MirrorSettings& settings);
  /// Instances of the scene have moved, from and to these places (GpuScene::move). Before `set_frame`.
  void move_instances(std::span<const shared::LightSphere> moved);
  /// Null: none does.
  [[nodiscard]] const MirrorPass* mirrored() const { return mirror_ ? &*mirror_ : nullptr; }
  /// From which on surfaces mirror nothing; 0: none does.
  [[nodiscard]] float mirror_roughness() const { return mirror_ ? mirror_->info().settings.roughness : 0.0F; }
  /// The last lights of the next frames stand still, as many as `lists` has, and are looked up in it by lightings that
  /// were made for it. Null: none do. It must live on, and be told before `set_frame`.
  /// Lists of triangles: their numbers are drawn wherever surfaces are.
  void light_still(const StillLists* lists);
  [[nodiscard]] const StillLists* still() const { return still_; }
  /// The probes of the next frames, for lightings that were made for their kind; null: none. They must live on, and be
  /// told before `cast_shadows`, `mirror` and `set_frame`. Forgets the frame.
  void light_probes(const ProbeSet* probes);
  [[nodiscard]] const ProbeSet& probes() const { return probes_ == nullptr ? no_probes_ : *probes_; }
  /// Of each light, as far as a method asked for them.
  [[nodiscard]] vulkan::Resource light_meshes() const { return vulkan::Resource::storage(plan_inputs().meshes); }
  /// Makes them for the frame that was drawn, whether or not a method asks for them.
  void make_reach(ShadowReach::Kind kind) {
    if (!shadows_) return;
    shadows_->need(kind);
    also([this](vulkan::Recorder& recorder) { shadows_->record_reach(recorder); });
  }
  /// What shading binds for them.
  [[nodiscard]] ShadowBound shadow_bound() const { return shadows_ ? shadows_->bound() : no_shadows_.bound(); }

  /// Camera, lights and decals of the next frames; depth runs as the renderer was told. A Lighting shows decals only if
  /// it was made for them.
  void set_frame(const View& view, std::span<const shared::Light> lights, std::span<const gpu::DecalData> decals = {}) {
    set_frame(std::span(&view, 1), lights, decals);
  }
  /// The same with as many views as the renderer was told, all of the targets' size.
  void set_frame(std::span<const View> views, std::span<const shared::Light> lights,
                 std::span<const gpu::DecalData> decals = {});
  /// The same frame from beside, for samples of a picture: shadow maps stay as they are, also what waits to be drawn.
  void set_views(std::span<const View> views, std::span<const shared::Light> lights,
                 std::span<const gpu::DecalData> decals);
  /// Another view of the same lights and decals, the lights at a time of their paths: moved on the GPU, which no host
  /// pass sees. `mover` must live until the next frame is submitted. Of one view with one sample a pixel, where no
  /// light casts shadows, stands still in lists of its own, or is mirrored.
  void move_frame(const View& view, const LightMover& mover, const PathTime& time);

  /// Where there are several views, or several samples a pixel, lights are culled for all of them at once, and frames
  /// draw and shade one: the first, unless another is chosen, until the next `set_frame`. Pixels of a sample are seen
  /// through its place.
  void show(const FramePicture& shown);
  /// All of a frame; the first comes last, so that who goes through them leaves it shown.
  [[nodiscard]] std::vector<FramePicture> all_pictures() const;
  [[nodiscard]] const HostDepth& depth() const { return depth_; }
  /// Of the frame, not through a sample.
  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  [[nodiscard]] const FramePicture& shown() const { return shown_; }

  /// Records and submits `warm_up` + `frames` frames; the picture is the last one's. The first timed frame draws
  /// shadows that are pending, whether or not those before it did.
  [[nodiscard]] Rendered render(Lighting& lighting, std::uint32_t frames = 1, std::uint32_t warm_up = 0);

  /// The same of one frame, for pictures that are checked and not timed: surfaces that an earlier frame of this view
  /// left in the G-buffer are not drawn again.
  [[nodiscard]] Rendered relight(Lighting& lighting);

  /// Renders one frame, whose picture stays in the targets: what `more` records comes behind it. Surfaces that an
  /// earlier frame of this view left in the G-buffer are not drawn again.
  [[nodiscard]] Rendered draw(Lighting& lighting, const std::function<void(vulkan::Recorder&)>& more);

  /// Submits what `record` records, and waits for it.
  void also(const std::function<void(vulkan::Recorder&)>& record);

  /// Culls the frame and shades nothing; draws its surfaces first where there are none yet. What did not fit, and what
  /// is needed of the plan's capacities; nothing of a plan that does not count. Culls for transparent surfaces too,
  /// where these have lists of their own: Lighting::any_depth_counts.
  [[nodiscard]] vulkan::FrameCounts cull(Lighting& lighting);

  /// Culls the depth that is there as if it were of another view, of one size or smaller, and shades nothing: what the
  /// frame before one's own may have been.
  void cull_as(Lighting& lighting, const View& other);

  /// A GPU that waits for the host lowers its clocks, and what is timed then says nothing. Renders untimed frames for
  /// about as long as it waited; nothing after a wait of less than 5 ms, and of a software device. Shadows that are
  /// pending stay so.
  void wake(Lighting& lighting);

  /// Records and submits one frame, reads nothing back but its times. Wakes the GPU first.
  [[nodiscard]] std::vector<vulkan::Timestamps::Time> time(Lighting& lighting, Timing timing);

  /// Culls and shades one frame and reads nothing back: for what a first use alone takes. Surfaces that an earlier
  /// frame of this view left in the G-buffer are not drawn again.
  void warm_up(Lighting& lighting);

  /// Draws the surfaces of the view into the G-buffer, unless they are there.
  void need_surfaces();

  /// Keeps a copy of the surfaces of this view, drawn first where there are none yet. Until the view changes, frames of
  /// the deferred paths copy that into the G-buffer instead of drawing, in less time. Nothing with lists of triangles.
  void keep_surfaces();

  /// The depth of the last frame, device depth, row by row.
  [[nodiscard]] std::vector<float> read_depth();

  /// The triangle of each pixel that is not sky, row by row. Draws the surfaces first where there are none yet. Of
  /// lists of triangles alone.
  [[nodiscard]] std::vector<std::uint32_t> read_triangles();

  /// Draws the surfaces of a frame, of a scene that has any, and reads their depth back.
  [[nodiscard]] std::vector<float> draw_depth();

  /// Draws the surfaces of a frame and reads them back. What is blended over them is not among them; decals are, if a
  /// lighting of a deferred path paints them.
  [[nodiscard]] CapturedFrame capture(Lighting* decals = nullptr);

  /// Culls the last frame's depth and walks the look-up of every pixel of the truth's rows. With `Passes::fused`, the
  /// look-up that culls in the shader. The truth is of one kind alone.
  enum class Kind : std::uint8_t { lights, decals, probes };
  [[nodiscard]] std::vector<Visit> visit(Lighting& lighting, const Truth& truth,
                                         vulkan::PlanRunner::Passes which = vulkan::PlanRunner::Passes::separate,
                                         Kind kind = Kind::lights);

  /// The same of every pixel, against nothing: for heat maps.
  [[nodiscard]] std::vector<Visit> visit_all(Lighting& lighting,
                                             vulkan::PlanRunner::Passes which = vulkan::PlanRunner::Passes::separate);

  /// Submits a pass and waits for it. Who destroys its buffers says so with `forget`.
  void run(const PixelPass& pass) { run(pass, pixel_pipeline(pass)); }
  /// The same with the pass's pipeline: for passes that differ in rows and constants alone.
  void run(const PixelPass& pass, const vulkan::Pipeline& pipeline);
  [[nodiscard]] vulkan::Pipeline pixel_pipeline(const PixelPass& pass) const;
  void forget(const vulkan::Buffer& buffer) { tracker_.forget(buffer.handle()); }

  [[nodiscard]] const Targets& targets() const { return *targets_; }
  [[nodiscard]] const FrameData& data() const { return data_; }
  [[nodiscard]] Context& context() { return context_; }
  [[nodiscard]] const vulkan::Device& device() const { return context_.device(); }
  /// That is drawn, through its sample.
  [[nodiscard]] const View& view() const { return shown_view_; }
  [[nodiscard]] EntityRanges entities() const { return data_.entities(); }
  /// Where the GPU has the record of a light of the frame: those of still lights are behind the boxes'.
  [[nodiscard]] std::uint32_t record_of(std::uint32_t light) const {
    const EntityRanges all = entities();
    return light < all.lights.count() ? light : light + all.boxes.count();
  }

 private:
  void draw_surfaces(Lighting* decals = nullptr);
  [[nodiscard]] std::vector<vulkan::Timestamps::Time> time_frame(Lighting& lighting, Timing timing);
  [[nodiscard]] Rendered render_frames(Lighting& lighting, std::uint32_t frames, std::uint32_t warm_up, bool relights);
  void record_frame(vulkan::Recorder& recorder, Lighting& lighting, bool relights);
  /// Records, submits and waits; then tells the lighting, if there is one.
  void submit(Lighting* lighting, const std::function<void(VkCommandBuffer)>& record);
  [[nodiscard]] LightingFrame lighting_frame() const;
  [[nodiscard]] vulkan::PlanInputs plan_inputs() const;
  /// What the method culls: of all views, where these are culled at once.
  [[nodiscard]] FrameData& culled_data() { return all_pictures_ ? all_pictures_->data : data_; }
  [[nodiscard]] const FrameData& culled_data() const { return all_pictures_ ? all_pictures_->data : data_; }
  void record_upload(vulkan::Recorder& recorder);
  /// Where the lighting's method reads them.
  void record_reach(vulkan::Recorder& recorder, const Lighting& lighting);
  void forget_surfaces();
  void draw_depths();
  template <class Texel>
  [[nodiscard]] std::vector<Texel> read_texels(const GpuImage& image);

  Context& context_;
  const ShaderLibrary& shaders_;
  const GpuScene& scene_;
  HostDepth depth_;
  std::unique_ptr<Targets> targets_;
  FrameData data_;
  const LightMover* mover_ = nullptr;  ///< of the frame that is to be uploaded, if its lights are moved
  PathTime time_;
  Geometry geometry_;
  std::vector<View> views_;
  FramePicture shown_;
  View shown_view_;
  /// What lights are culled with where there are several views, or several samples a pixel.
  struct AllPictures {
    FrameData data;
    std::vector<SampledDepth> depths;  ///< one a view
  };
  std::optional<AllPictures> all_pictures_;
  std::vector<vulkan::Resource> culled_depths_;  ///< one a view
  bool surfaces_drawn_ = false;                  ///< the G-buffer has those of shown_view_, without decals
  std::optional<CapturedSurfaces> kept_;         ///< of shown_view_
  NoShadows no_shadows_;
  std::unique_ptr<ProbeAtlas> no_captures_;
  ProbeSet no_probes_;
  const ProbeSet* probes_ = nullptr;
  StillTree still_tree_;
  std::optional<Shadows> shadows_;
  std::optional<MirrorPass> mirror_;
  StillLists no_still_;
  const StillLists* still_ = nullptr;
  std::uint32_t light_capacity_;
  std::uint32_t decal_capacity_;
  vulkan::AccessTracker tracker_;
  vulkan::Timestamps timestamps_;
};

}  // namespace lamp::app
