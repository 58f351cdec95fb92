// One object for engines that want no plans: depth, camera and lights in, a look-up out.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/method.h"
#include "lamplight/shared/counters.h"
#include "lamplight/view.h"
#include "lamplight/vulkan/plan_runner.h"

namespace lamp::vulkan {

struct CullerInfo {
  std::uint32_t width = 0;   ///< pixels, of the largest frame
  std::uint32_t height = 0;  ///< likewise
  std::uint32_t views = 1;   ///< of a frame, 1 .. MAX_VIEWS: eyes, faces of a cube, parts of a split screen
  std::uint32_t light_capacity = 0;
  std::string method = "clustered";    ///< `lamp list methods`
  std::vector<std::string> options{};  ///< "tile=32"
  LightLayout light_layout{};          ///< what frames bring of each light, and where it lies
  std::uint32_t depth_samples = 1;     ///< of the depth image, a pixel: a power of two up to 64
  bool brings_spheres = false;  ///< frames bring the lights' spheres; else a method that reads them makes them itself
  /// Where the look-up is read. On a queue without graphics: VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT.
  VkPipelineStageFlags2 readers = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  std::uint32_t frames_in_flight = MAX_FRAMES_IN_FLIGHT;  ///< that may be recorded and not done yet, 1 .. that
  /// Barriers that a renderer records anyway, before the passes and behind them, order what the Culler's own two would:
  /// they contain Culler::barrier_before and Culler::barrier_behind. The Culler then records neither.
  bool host_barriers = false;
  /// Only for world-tree, else an error: a storage buffer with WorldTree::words, which the caller keeps, and brings up
  /// to date after changes. None: every point walks every light.
  BufferPart still{};
};

/// One of several views of a frame. The look-up takes its place among them.
struct CullerView {
  const View* view = nullptr;            ///< with a size of its own
  VkImage depth_image = VK_NULL_HANDLE;  ///< these as in CullerFrame
  VkImageView depth_view = VK_NULL_HANDLE;
  VkImageLayout depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  VkOffset2D depth_offset = {0, 0};
};

/// What a frame brings. Lights, their count, spheres and depth must be visible to compute shaders when the recorded
/// commands run, also for methods that draw, and may change once compute shaders have read them.
struct CullerFrame {
  const View* view = nullptr;  ///< of any size up to the Culler's; another one each frame, if need be
  /// Storage buffers. The part of each begins at a multiple of 16 bytes and of minStorageBufferOffsetAlignment.
  BufferPart lights{};   ///< of shared::Light (`lamp::pack`), or what CullerInfo::light_layout says
  BufferPart cones{};    ///< of shared::LightCone, where the layout has them
  BufferPart spheres{};  ///< CullerInfo::brings_spheres: of shared::LightSphere (`lamp::bounding_spheres`), which is a
                         ///< quarter to read
  BufferPart radial{};   ///< read with option occlusion=radial alone: of shared::RadialBound, of the first lights, at
                         ///< least one; nothing cuts the others
  BufferPart meshes{};   ///< read with option proxy=cut alone: of shared::LightMesh, likewise
  std::uint32_t light_count = 0;  ///< at most the capacity; with the boxes
  /// How many of them, the last ones, are boxes: decals, then probes (`lamp::entity_records`). Option boxes=shape tests
  /// these by their shape; without a count they are tested by their spheres, as lights are.
  std::uint32_t box_count = 0;
  std::uint32_t probe_count = 0;  ///< how many of the boxes, the last ones, are probes (`first_probe`, common/box.glsl)
  /// Instead of light_count, for lights that the GPU makes: a buffer with the count, a 32-bit word. Its usage has
  /// VK_BUFFER_USAGE_TRANSFER_SRC_BIT. Of more lights than the capacity the first ones are taken, and the others
  /// counted (Counters::excess_lights).
  VkBuffer light_count_buffer = VK_NULL_HANDLE;
  VkDeviceSize light_count_offset = 0;           ///< bytes, a multiple of 4
  std::span<const shared::Light> host_lights{};  ///< only for options that work on the CPU: the same lights
  VkImage depth_image = VK_NULL_HANDLE;          ///< only for methods that need depth: device depth, reversed or not as
                                                 ///< the view says; may be larger than the picture
  VkImageView depth_view = VK_NULL_HANDLE;       ///< 2D, of its depth aspect alone and of one layer
  VkImageLayout depth_layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  VkOffset2D depth_offset = {0, 0};     ///< where the picture begins in the depth image, pixels, not negative
  std::span<const CullerView> views{};  ///< CullerInfo::views of them, instead of `view` and the depth above
};

/// What `Culler::finish` changed.
enum class Growth : std::uint8_t {
  none,
  buffers,    ///< buffers of the look-up: bind its resources anew
  constants,  ///< and its constants: make your pipelines anew
};

/// Owns the buffers and pipelines of one method, for frames up to a size. Frames run on the GPU one after the other, as
/// on one queue they do, in the order in which they were recorded. Up to CullerInfo::frames_in_flight may be under way:
/// when a frame is recorded, those before the last frames_in_flight - 1 are done, or were dropped.
class LAMPLIGHT_API Culler {
 public:
  Culler() = default;
  /// Errors: a device that `make_device` did not make, an unknown method (with the nearest names), an unknown option
  /// (with all that the method has), an option twice, `still` for a method that reads none, a size or capacity beyond
  /// the device's limits, no memory left.
  [[nodiscard]] static Result<Culler> create(const Device& device, const CullerInfo& info);

  /// Records the passes, into a primary or a secondary command buffer outside of a render pass. What they wrote is
  /// visible to CullerInfo::readers recorded later. Returns the frame's number, from 1 on. A recorded frame may be
  /// dropped (`drop`): none relies on what another one would have done. Errors, and then nothing is recorded: no
  /// command buffer, no view or a larger one, another number of views, a handle that the method needs and that is
  /// missing, more lights than the capacity, fewer host lights than lights, a count on the GPU for an option that works
  /// on the CPU.
  [[nodiscard]] Result<std::uint64_t> record(VkCommandBuffer commands, const CullerFrame& frame);

  /// Makes room where lists of a frame did not fit, with a quarter in reserve, for the frames that are recorded from
  /// now on, and spares them passes whose output is kept while the projection stays the same (`frusta=cached`). Call it
  /// after the frame's fence, before frames_in_flight further frames are recorded; it waits for nothing. Frames that
  /// are still under way keep their buffers, which are freed when the last of them is finished. A device or a method
  /// that allows no more room changes nothing: lists that do not fit are walked the long way. Errors: no memory left;
  /// the Culler goes on as it was.
  [[nodiscard]] Result<Growth> finish(std::uint64_t frame);

  /// Says that a frame was recorded and will never run, so that it is under way no longer.
  void drop(std::uint64_t frame);

  /// With CullerInfo::host_barriers: what the barrier before the passes contains, and that between them and whatever
  /// reads the look-up, with the host, which reads the counts. Lights, their count, spheres and depth must be visible
  /// to the second stages of the first. They change when the Culler grows.
  [[nodiscard]] VkMemoryBarrier2 barrier_before() const;
  [[nodiscard]] VkMemoryBarrier2 barrier_behind() const;

  /// How a shader reads the result, of all views: the file lookup/NAME.glsl, constants for its specialization,
  /// resources for its descriptors (set 0, bindings from LOOKUP_BINDING). Holds until the Culler is destroyed, moved or
  /// assigned to, or grows in `finish`.
  [[nodiscard]] BoundLookUp lookup() const;

  /// What the frame that was recorded last counted: cells that did not fit and were walked the long way, and lights
  /// beyond the capacity. Read it after that frame's fence; before it has run, nothing was counted.
  [[nodiscard]] shared::Counters counters() const;

  /// Bytes on the GPU of the buffers in use.
  [[nodiscard]] std::uint64_t bytes() const { return runner_.plan().bytes(); }
  /// What there is to know of the plan on this device, a sentence each: such as how many lights a pixel can walk where
  /// the device ends loops. They change when the Culler grows.
  [[nodiscard]] std::span<const std::string> notes() const { return runner_.plan().notes; }
  /// The method's options, as they have grown.
  [[nodiscard]] const Options& options() const { return problem_.options; }

 private:
  /// Buffers that frames up to `last_frame` still use.
  struct Retired {
    PlanRunner runner;
    std::uint64_t last_frame = 0;
  };
  [[nodiscard]] std::optional<std::uint32_t> slot_of(std::uint64_t frame) const;
  [[nodiscard]] std::uint32_t take_slot(std::uint64_t frame);
  /// A frame's views, and what plans see of them.
  struct Views {
    std::array<shared::Frame, MAX_VIEWS> records{};
    std::array<Resource, MAX_VIEWS> depths;
  };
  void reserve();
  [[nodiscard]] Result<Views> views_of(const CullerFrame& frame) const;
  [[nodiscard]] BufferPart write_records(const Views& views) const;
  void record_frame(Recorder& recorder, const Views& views, const CullerFrame& frame) const;
  void record_light_count(Recorder& recorder) const;
  [[nodiscard]] std::span<std::byte> light_count_in(std::uint32_t slot) const;
  [[nodiscard]] FrameCounts counts_of(std::uint64_t frame, std::uint32_t slot) const;
  [[nodiscard]] Result<Growth> grow(GrownPlan grown);

  Device device_;
  const Method* method_ = nullptr;
  Problem problem_;
  Buffer frame_;                      ///< of the look-up, which shows the same part in every frame
  Buffer records_;                    ///< host_barriers: the same for the passes, one for each frame in flight
  Buffer light_counts_;               ///< of the GPU, read back: one for each frame in flight
  std::vector<std::uint64_t> slots_;  ///< the frame that has each, or FREE
  std::uint32_t last_slot_ = 0;
  PlanRunner runner_;
  VkPipelineStageFlags2 readers_ = 0;
  bool host_barriers_ = false;
  BufferPart still_;
  AccessTracker tracker_;  ///< of one record alone; here so that the next one allocates nothing
  std::vector<Retired> retired_;
  std::uint64_t frames_ = 0;       ///< that were recorded
  std::uint64_t first_frame_ = 1;  ///< of the runner
  std::uint64_t last_finished_ = 0;
  shared::Counters finished_counters_{};  ///< of that frame
};

}  // namespace lamp::vulkan
