// Runs a plan: owns its buffers and pipelines, records its passes, hands out its look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/method.h"
#include "lamplight/plan.h"
#include "lamplight/shared/counters.h"
#include "lamplight/shared/frame.h"
#include "lamplight/vulkan/bound_lookup.h"
#include "lamplight/vulkan/descriptor_sets.h"
#include "lamplight/vulkan/pass_pipeline.h"
#include "lamplight/vulkan/recorder.h"

namespace lamp::vulkan {

/// What a frame brings. The buffers and the depth image must live until the frame is done.
struct PlanInputs {
  BufferPart frame;                  ///< a shared::Frame of each view; usable as uniform and as storage buffer
  BufferPart lights;                 ///< as many as the record says, in the plan's layout
  BufferPart cones;                  ///< likewise, where the layout has them
  BufferPart spheres;                ///< shared::LightSphere, as many
  BufferPart radial;                 ///< shared::RadialBound of the first lights, at least one; nothing cuts others
  BufferPart meshes;                 ///< shared::LightMesh, likewise
  BufferPart still;                  ///< WorldTree::words; none: every point walks every light
  Resource depth;                    ///< image, view, aspect and layout; unset where none is needed
  std::span<const Resource> depths;  ///< of several views: one each, instead
  std::span<const shared::Light> host_lights;  ///< for host passes: the same lights
  std::uint32_t slot = 0;                      ///< below the plan's frames in flight; of no frame that is not done yet
  /// The records of the views, as in `frame`. If the GPU counts the lights there, with the most that there may be,
  /// which passes are dispatched for.
  const shared::Frame* host_frame = nullptr;
};

/// Passes before all others: that which fills a plan's buffers from what host passes wrote, and that which clears its
/// `zeroed` buffers.
inline constexpr std::string_view UPLOAD_PASS = "upload";
inline constexpr std::string_view CLEAR_PASS = "clear";

/// What a frame of a plan counted: of all views together, but for what lists need, which is the most that any did.
struct FrameCounts {
  shared::Counters counters{};
  std::vector<std::uint32_t> needed;  ///< of the plan's capacities, in their order; the most of any view
};

class LAMPLIGHT_API PlanRunner {
 public:
  enum class Passes : std::uint8_t { separate, fused };

  PlanRunner() = default;
  /// Allocates the buffers and builds the pipelines of a plan that `plan_check` lets pass on this device, as it does
  /// those of `make_plan`: it is not checked again, for its shaders may be others than the library's.
  [[nodiscard]] static Result<PlanRunner> create(const Device& device, Plan plan,
                                                 const ShaderSource& shaders = embedded_shaders);

  /// Records the passes: all of them, or those that a fused shader needs before it. Returns the record's number, from 1
  /// on. Errors, and then nothing is recorded: `check`'s.
  [[nodiscard]] Result<std::uint64_t> record(Recorder& recorder, const PlanInputs& inputs,
                                             Passes which = Passes::separate);

  /// What of a frame does not go with the plan: a handle that it needs, a part of a buffer that begins at an odd place
  /// or is too short, a larger size, more lights than its capacity, fewer host lights than lights. The first such
  /// thing, or nothing.
  [[nodiscard]] std::optional<Error> check(const PlanInputs& inputs) const;

  /// Says that the record of that number has run, and all before it that were not dropped. Passes that are kept need
  /// not be recorded again, until the projection changes; nobody else may write their buffers.
  void finish(std::uint64_t record);
  /// How many records there were: the number of the last.
  [[nodiscard]] std::uint64_t records() const { return records_; }

  /// The pipeline stages that its passes run in: inputs must be visible to these, of shaders.
  [[nodiscard]] VkPipelineStageFlags2 stages() const;

  /// Records that the host will read the counts of the last record, after the frame's fence.
  void record_counts(Recorder& recorder);
  /// What the frame that was recorded last for that slot counted. Until it has run, nothing.
  [[nodiscard]] FrameCounts counts(std::uint32_t slot = 0) const;

  [[nodiscard]] const Plan& plan() const { return plan_; }
  /// A host pass of the last record(), and how long it took on the CPU.
  struct HostTime {
    std::string_view pass;  ///< of the plan
    double ms = 0.0;
  };
  [[nodiscard]] std::span<const HostTime> host_times() const { return host_times_; }
  /// What the driver says of a pass's pipeline (Pipeline::statistics); of the first pass of that name.
  [[nodiscard]] std::span<const PipelineStatistic> statistics(std::string_view pass) const;
  /// How often passes that are kept have been recorded.
  [[nodiscard]] std::uint64_t projection_rebuilds() const { return projection_rebuilds_; }
  /// Of all views; a fused one is that of the view.
  [[nodiscard]] BoundLookUp lookup(const PlanInputs& inputs, Passes which = Passes::separate,
                                   std::uint32_t view = 0) const;
  /// The buffer of a plan's resource, VK_NULL_HANDLE for inputs.
  [[nodiscard]] VkBuffer buffer(ResourceId id) const;

 private:
  struct BuiltPass {
    /// With cells of a size.
    struct Sized {
      std::uint32_t shift = 0;  ///< Frame::cell_shift
      Extent extent;
      Pipeline pipeline;
    };
    Pass pass;
    std::vector<Sized> sizes;           ///< the plan's own first, then its finer ones
    std::vector<VkDescriptorSet> sets;  ///< one a slot and view, of any size; none where descriptors are pushed

    [[nodiscard]] const Sized& of_shift(std::uint32_t shift) const;
  };
  /// A pass for one of the views, with what it touches.
  struct BoundPass {
    std::size_t pass = 0;
    std::uint32_t view = 0;
    std::vector<Bound> resources;
    std::vector<Use> uses;  ///< of these, and of the buffer with its counts
  };
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  /// Passes in their order, those of all views beside one another; and which may run side by side.
  struct Sequence {
    std::vector<BuiltPass> passes;
    std::vector<BoundPass> bound;
    std::vector<Range> together;  ///< of `bound`: none of these waits for another
  };
  [[nodiscard]] std::optional<Error> check_lights(const PlanInputs& inputs) const;
  [[nodiscard]] std::optional<Error> check_depths(const PlanInputs& inputs) const;
  [[nodiscard]] Resource resource(ResourceId id, const PlanInputs& inputs, std::uint32_t view) const;
  [[nodiscard]] Resource all_views(ResourceId id, const PlanInputs& inputs) const;
  [[nodiscard]] BufferPart part(ResourceId id, std::uint32_t view, std::uint32_t slot) const;
  [[nodiscard]] std::span<std::byte> count_bytes(std::uint32_t slot) const;
  [[nodiscard]] Result<Sequence> build(const Device& device, const std::vector<Pass>& passes,
                                       const ShaderSource& shaders);
  [[nodiscard]] static std::optional<Error> add_size(const Device& device, BuiltPass& built, const Pass& pass,
                                                     std::uint32_t shift, const ShaderSource& shaders);
  [[nodiscard]] std::optional<Error> build_finer(const Device& device, const ShaderSource& shaders);
  [[nodiscard]] std::optional<Error> make_sets(const Device& device, BuiltPass& built);
  void bind_all(Sequence& sequence) const;
  void reserve();
  void bind_inputs(Sequence& sequence, const PlanInputs& inputs) const;
  [[nodiscard]] VkDescriptorSet set(const BuiltPass& built, std::uint32_t slot, std::uint32_t view) const;
  void record_host_passes(Recorder& recorder, const Sequence& sequence, const PlanInputs& inputs);
  void run_on_host(const Pass& pass, const PlanInputs& inputs, std::uint32_t view);
  void upload(Recorder& recorder, std::uint32_t slot);
  void record_together(Recorder& recorder, const Sequence& sequence, const Range& range, const PlanInputs& inputs);
  void dispatch(const Recorder& recorder, const Extent& extent, const PlanInputs& inputs, std::uint32_t view) const;
  void draw(const Recorder& recorder, const Pass& pass, const PlanInputs& inputs, std::uint32_t view) const;
  [[nodiscard]] bool is_kept(std::uint32_t view, const shared::Frame& frame, std::uint64_t record);
  void zero_buffers(Recorder& recorder, const PlanInputs& inputs);

  Plan plan_;
  std::vector<Buffer> buffers_;  ///< with a part for each view; of counts, all of them for each slot
  std::vector<Buffer> slots_;    ///< of each buffer of upload memory, one behind the other, mapped; else none
  OwnedSampler depth_sampler_;
  Buffer every_light_;  ///< a tree of every light, where the plan reads one and the host brings none
  DescriptorSets sets_;
  std::uint32_t offset_alignment_ = 1;  ///< bytes, of storage buffers
  bool addressable_ = false;            ///< buffers have addresses
  Sequence separate_;
  Sequence fused_;
  /// What a view's passes that are kept are recorded with, from which record on, and whether one of these is known to
  /// have run. Each of them records the passes until then, so that it does not matter which.
  struct Kept {
    Mat4 projection{};
    UVec2 size_px{};
    std::uint64_t first_record = 0;
    bool has_run = false;
  };
  std::array<std::optional<Kept>, MAX_VIEWS> kept_;
  std::uint64_t projection_rebuilds_ = 0;
  std::vector<HostTime> host_times_;
  std::uint64_t records_ = 0;
  // Room that records use again, so that they allocate nothing.
  std::vector<Use> uses_;
  std::vector<ResourceId> written_;
  std::vector<std::span<std::byte>> mapped_;
};

}  // namespace lamp::vulkan
