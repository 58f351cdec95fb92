// Records passes: barriers from declared uses, debug labels, timestamps, descriptors.
// Promise: between two uses of a resource stands the smallest barrier that orders them; a pass that declares all its
// uses needs no thought about synchronization.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/vulkan/buffer.h"
#include "lamplight/vulkan/pipeline.h"

namespace lamp::vulkan {

/// A buffer or an image, as a descriptor and as something to synchronise.
struct Resource {
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< buffers: the part that a descriptor shows
  VkDeviceSize range = VK_WHOLE_SIZE;
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< while used this way
  VkSampler sampler = VK_NULL_HANDLE;

  [[nodiscard]] static Resource storage(const BufferPart& part) {
    return {.buffer = part.buffer, .offset = part.offset, .range = part.bytes};
  }
};

/// How a pass uses a resource.
struct Use {
  Resource resource;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  VkAccessFlags2 access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  bool discard = false;  ///< images: the old contents may be lost
};

/// A resource at a descriptor binding.
struct Bound {
  std::uint32_t binding = 0;
  Resource resource;
};

/// Remembers, over any number of command buffers of one queue, who last touched what. It believes that what it was told
/// of runs, in that order. Whoever drops a command buffer goes on with a copy from before, or with a new tracker behind
/// `Recorder::order`.
class LAMPLIGHT_API AccessTracker {
 public:
  /// Puts a barrier for these uses into the command buffer, if one is needed, and remembers them.
  void barrier(const DeviceFunctions& vk, VkCommandBuffer commands, std::span<const Use> uses);
  /// What the next call of `barrier` orders besides.
  void add(const VkMemoryBarrier2& besides);
  /// Forgets all, and keeps the memory for it.
  void reset() {
    known_.clear();
    besides_ = no_barrier();
  }
  /// Memory for as many resources, of which so many are images.
  void reserve(std::size_t resources, std::size_t images) {
    known_.reserve(resources);
    images_.reserve(images);
  }
  /// Takes over a resource that somebody else synchronised: it is in `resource.layout` and needs no barrier to be read.
  void assume(const Resource& resource);
  /// Forgets a buffer that is about to be destroyed: its handle may come back as another's.
  void forget(VkBuffer buffer);

 private:
  struct State {
    VkPipelineStageFlags2 write_stages = 0;
    VkAccessFlags2 write_access = 0;
    VkPipelineStageFlags2 read_stages = 0;     // since the write
    VkPipelineStageFlags2 visible_stages = 0;  // stages that already wait for the write,
    VkAccessFlags2 visible_access = 0;         // and see it by each of these
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  };
  State& state_of(const Resource& resource);
  /// Not `{.sType = ...}`: hosts that include this may have -Wmissing-field-initializers on.
  static VkMemoryBarrier2 no_barrier() {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    return barrier;
  }
  struct Known {
    std::uint64_t key = 0;
    State state;
  };
  std::vector<Known> known_;                   ///< as many as a frame touches, a few dozen
  std::vector<VkImageMemoryBarrier2> images_;  ///< of one barrier; here so that the next one allocates nothing
  VkMemoryBarrier2 besides_ = no_barrier();
};

/// Begin and end times of named passes, or of runs of passes that belong together.
class LAMPLIGHT_API Timestamps {
 public:
  /// Which part of the frame a pass belongs to, by any number.
  using PartOf = std::function<int(std::string_view)>;
  struct Time {
    std::string pass;
    double begin_ms = 0.0;  ///< since the first pass began
    double end_ms = 0.0;

    [[nodiscard]] double ms() const { return end_ms - begin_ms; }
  };
  Timestamps() = default;
  [[nodiscard]] static Result<Timestamps> create(const Device& device, std::uint32_t max_passes);
  /// With `part_of`, neighbouring passes of one part share a time, that has the first one's name: taking a time costs
  /// a GPU about a microsecond.
  void reset(VkCommandBuffer commands, PartOf part_of = {});
  void begin(VkCommandBuffer commands, std::string_view pass);
  void end(VkCommandBuffer commands);
  /// After the last pass.
  void finish(VkCommandBuffer commands);
  /// When each pass began and ended, after the work is done.
  [[nodiscard]] std::vector<Time> read() const;

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  DeviceFunctions vk_;
  OwnedQueryPool pool_;
  float period_ns_ = 1.0F;
  std::uint32_t max_passes_ = 0;
  std::vector<std::string> passes_;
  PartOf part_of_;
  bool open_ = false;  ///< the last time has no end yet
};

/// What ran in `before` comes before what runs in `after`, and what it wrote can be read there.
[[nodiscard]] LAMPLIGHT_API VkMemoryBarrier2 full_barrier(VkPipelineStageFlags2 before, VkPipelineStageFlags2 after);

class LAMPLIGHT_API Recorder {
 public:
  /// `timestamps` may be null.
  Recorder(const Device& device, VkCommandBuffer commands, AccessTracker& tracker, Timestamps* timestamps = nullptr)
      : device_(device), commands_(commands), tracker_(tracker), timestamps_(timestamps) {}

  /// From here on, passes are named "GROUP: NAME": who runs a plan for a second purpose can tell its times apart.
  /// Empty: names as they are.
  void name_group(std::string_view group) { group_ = group; }
  /// Label, timestamp, barrier.
  void begin_pass(std::string_view name, std::span<const Use> uses);
  void begin_pass(std::string_view name, std::initializer_list<Use> uses) { begin_pass(name, std::span(uses)); }
  void end_pass();
  /// What was recorded before and runs in `before` comes before what is recorded from now on and runs in `after`, and
  /// what it wrote can be read there, whoever recorded it.
  void order(VkPipelineStageFlags2 before, VkPipelineStageFlags2 after) { order(full_barrier(before, after)); }
  void order(const VkMemoryBarrier2& barrier);
  /// The same by the barrier of the next pass or transfer: a GPU stops at each.
  void order_with_next(const VkMemoryBarrier2& barrier) { tracker_.add(barrier); }
  /// Only the barrier: for transfers between passes.
  void barrier(std::span<const Use> uses) { tracker_.barrier(device_.vk, commands_, uses); }
  void barrier(std::initializer_list<Use> uses) { barrier(std::span(uses)); }

  /// Binds a pipeline and the descriptors of all its bindings: pushed, or in a set of Device::sets. If that has no
  /// memory left, it says so (DescriptorSets::error), and no descriptors are bound.
  void bind(const Pipeline& pipeline, std::span<const Bound> resources);
  /// The same with a set of the caller's own, which no commands under way use; null where descriptors are pushed.
  void bind(const Pipeline& pipeline, std::span<const Bound> resources, VkDescriptorSet set);
  /// Descriptors that change between draws: the others stay as `bind` had them.
  void push(const Pipeline& pipeline, std::span<const Bound> resources);

  [[nodiscard]] VkCommandBuffer commands() const { return commands_; }
  [[nodiscard]] const Device& device() const { return device_; }

 private:
  void push_writes(const Pipeline& pipeline, std::span<const Bound> resources) const;
  void bind_set(const Pipeline& pipeline, std::span<const Bound> resources, VkDescriptorSet set) const;

  const Device& device_;
  VkCommandBuffer commands_;
  AccessTracker& tracker_;
  Timestamps* timestamps_;
  std::string group_;
  std::vector<Bound> bound_;  ///< in the last set of Device::sets: what the next of the same pipeline begins with
};

}  // namespace lamp::vulkan
