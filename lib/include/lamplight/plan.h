// A plan: what a method does to one frame, as data. Buffers, passes, and how to look the result up.
// Based on: the dispatch lists of NVIDIA's Real-time Denoisers (NRD); the library allocates nothing here.
// Promise: a plan needs no device, so its memory is known before a GPU exists.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/light_layout.h"
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

namespace lamp {

/// A resource of a plan: one of the inputs below, or `PLAN_BUFFER + i` for the plan's i-th buffer.
using ResourceId = std::uint32_t;

/// A view's shared::Frame, a uniform buffer in compute passes, else a storage buffer; a look-up sees those of all
/// views.
inline constexpr ResourceId INPUT_FRAME = 0;
inline constexpr ResourceId INPUT_LIGHTS = 1;   ///< storage buffer, what Plan::light_layout says of each light
inline constexpr ResourceId INPUT_DEPTH = 2;    ///< sampled image, device depth; may be larger than the picture
inline constexpr ResourceId INPUT_SPHERES = 3;  ///< storage buffer, shared::LightSphere[light capacity]
inline constexpr ResourceId INPUT_CONES = 4;    ///< storage buffer, likewise, where the layout has cones
/// Storage buffer, shared::RadialBound of the first lights: where option occlusion=radial reads it.
inline constexpr ResourceId INPUT_RADIAL = 5;
/// Storage buffer, shared::LightMesh of the first lights: where option proxy=cut reads it.
inline constexpr ResourceId INPUT_MESHES = 6;
/// Storage buffer of 32-bit words that the host made ahead, of lights that stand still (WorldTree::words): nothing of a
/// frame. Where the host brings none, every point walks every light.
inline constexpr ResourceId INPUT_STILL = 7;
inline constexpr ResourceId PLAN_BUFFER = 8;  ///< the first buffer of the plan
inline constexpr ResourceId NO_RESOURCE = ~0U;

enum class Access : std::uint8_t { read, write, read_write };

/// A resource at a shader's binding. The binding number is the place in its list.
struct Binding {
  ResourceId resource = NO_RESOURCE;
  Access access = Access::read;

  friend bool operator==(const Binding&, const Binding&) = default;
};

enum class BufferMemory : std::uint8_t {
  device,  ///< GPU only
  upload,  ///< likewise, filled from what host passes write: mapped memory besides, for each frame in flight
  counts,  ///< the counters: a part for each frame in flight, mapped, which the host reads when the frame is done
};

/// Cells of a frame's picture: squares, of the tiles' kind, in layers. px 0: none.
struct CellGrid {
  std::uint32_t px = 0;  ///< of a square's side; partial squares at the right and bottom count
  std::uint32_t layers = 1;

  [[nodiscard]] std::uint32_t across(std::uint32_t width) const { return width / px + (width % px == 0 ? 0 : 1); }
  [[nodiscard]] std::uint64_t count(std::uint32_t width, std::uint32_t height) const {
    return std::uint64_t{across(width)} * across(height) * layers;
  }
};

struct BufferDesc {
  std::string name;
  std::uint64_t bytes = 0;  ///< of a view; > 0, a multiple of 4
  BufferMemory memory = BufferMemory::device;
  bool zeroed = false;           ///< filled with zeros at the start of every frame; not upload memory
  CellGrid zeroed_cells;         ///< px not 0: at most as far as the cells of the frame's picture reach,
  std::uint64_t cell_bytes = 0;  ///< of as many bytes each, a multiple of 4
  bool zeroed_by_pass = false;   ///< likewise, but by the first pass that binds it, which only writes it
  bool indirect = false;         ///< holds group or draw counts
  bool all_views = false;        ///< one for all views, written by passes that run once (Pass::once)

  [[nodiscard]] bool begins_at_zero() const { return zeroed || zeroed_by_pass; }
};

/// How many work groups a compute pass has, or how many vertices and instances a raster pass draws.
struct LAMPLIGHT_API Extent {
  std::uint32_t x = 1;                 ///< groups in x; raster: vertices of an instance
  std::uint32_t y = 1;                 ///< groups in y; raster: instances
  std::uint32_t z = 1;                 ///< groups in z; raster: unused
  std::uint32_t lights_per_group = 0;  ///< not 0: x (raster: y) is ceil(light count of the frame / this)
  CellGrid cells;                      ///< px not 0: x and y are the squares across and down the frame's picture
  std::uint32_t cells_per_group = 0;   ///< not 0: x is ceil(all of those cells / this) and x besides, y as it is
  ResourceId indirect = NO_RESOURCE;   ///< not NO_RESOURCE: read from this buffer instead
  std::uint64_t indirect_offset = 0;   ///< bytes, a multiple of 4

  /// The groups of a frame, or vertices and instances, unless they are read from a buffer.
  [[nodiscard]] std::array<std::uint64_t, 3> counts(std::uint32_t width, std::uint32_t height,
                                                    std::uint32_t lights) const;
};

enum class PassKind : std::uint8_t { compute, raster, host };

/// Raster passes have no colour attachment: fragments write to buffers.
struct RasterState {
  std::string vertex_shader;
  std::uint32_t pixel = 1;    ///< pixels of the picture along a side of one of the viewport, which covers it
  std::uint32_t samples = 1;  ///< 1 or 4: what every device has without attachments
  bool conservative = false;  ///< every pixel that a triangle touches; only where DeviceTraits has it
  enum class Cull : std::uint8_t { none, front, back } cull = Cull::none;  ///< front faces are counter-clockwise
};

/// What a host pass sees: the frame's lights as the host knows them, and the frame's slots of the buffers that it
/// declared, mapped, in order.
struct HostContext {
  std::span<const shared::Light> lights;
  const shared::Frame* frame = nullptr;
  std::span<const std::span<std::byte>> buffers;
  std::span<const std::uint32_t> constants;  ///< the pass's
};
using HostFunction = void (*)(const HostContext&);

/// One step. Barriers follow from the declared accesses: neighbours of which neither writes what the other touches may
/// run side by side. The name becomes its debug label and its row in the times.
struct Pass {
  std::string name;
  PassKind kind = PassKind::compute;
  std::string shader;                    ///< compute or fragment shader; name in the shader table ("methods/tiled")
  std::vector<std::uint32_t> constants;  ///< specialization constants 0, 1, 2, ...; what a host pass is told
  std::vector<Binding> bindings;         ///< set 0, bindings 0, 1, 2, ...
  Extent extent;
  RasterState raster;                 ///< raster passes
  HostFunction host = nullptr;        ///< host passes; they run while recording, before every GPU pass
  std::string option;                 ///< host passes: the setting that asks for it ("sort=cpu"), for messages
  bool once = false;                  ///< for all views together: reads lights alone; else once for each view
  bool on_projection_change = false;  ///< kept: not in frames of a projection with which it has run just before
  std::uint32_t full_subgroups = 0;   ///< not 0: threads of a work group, all in x, whose subgroups must all be full
};

/// How a shader reads the result: the file lookup/NAME.glsl, its constants and its buffers.
struct LookUp {
  std::string name;
  std::vector<std::uint32_t> constants;  ///< specialization constants LOOKUP_CONSTANT + 0, 1, ...
  std::vector<Binding> bindings;         ///< set 0, bindings LOOKUP_BINDING + 0, 1, ...; read
  /// Of each binding, 32-bit words from one view's part of its buffer to the next one's; none where there is one view.
  std::vector<std::uint32_t> view_words;
  /// Lights that a pixel surely can walk. Where a device ends loops and the method says nothing, `make_plan` does.
  std::uint64_t most_walked = ~0ULL;
};

/// Rounds of a look-up's loops for each light, at most, where its plan says nothing else: two loops, one in the other.
inline constexpr std::uint32_t WALK_ROUNDS = 3;

/// Where a look-up's constants and bindings begin, in every shader that includes one (lookup/ *.glsl, *.hlsl) and does
/// not say otherwise (lookup/parts/resources.glsl).
inline constexpr std::uint32_t LOOKUP_CONSTANT = 100;
inline constexpr std::uint32_t LOOKUP_VIEW_CONSTANT = 120;  ///< + the place of a binding: its LookUp::view_words
inline constexpr std::uint32_t LOOKUP_BINDING = 16;

/// A compute shader that culls and shades in one dispatch includes this look-up, whose walk reads shared memory. It may
/// write one buffer, the plan's counters. The shader's work group must be `group_width` x `group_height` pixels.
struct FusedLookUp {
  LookUp lookup;
  std::vector<Pass> passes;  ///< what must run before, instead of Plan::passes
  std::uint32_t group_width = 0;
  std::uint32_t group_height = 0;
  std::uint32_t shared_bytes = 0;  ///< shared memory of a work group, for plan_check
};

/// What runs instead of Plan::passes in smaller pictures, whose cells are finer: the same shaders over the same
/// buffers, with other constants and extents.
struct FinerPasses {
  std::uint32_t shift = 0;       ///< > 0: sides of the cells are halved as often; of a frame, Frame::cell_shift
  CellGrid cells;                ///< of this size
  std::uint64_t most_cells = 0;  ///< for pictures of at most as many
  std::vector<Pass> passes;      ///< one for each of Plan::passes
};

/// Entries that a plan has room for, and where a frame counts how many it needed. What does not fit is walked the long
/// way in that frame; a host can make room for the next one (`grow_plan`).
struct Capacity {
  std::string_view option;          ///< of the method, that it grows with
  std::uint64_t entries = 0;        ///< that there is room for
  std::uint64_t per_option = 0;     ///< entries that one more of the option adds
  std::uint64_t needed_offset = 0;  ///< bytes, a multiple of 4: where in the counters there is a 32-bit count of what
                                    ///< was needed, or less than that where something else did not fit either, but
                                    ///< then more than `entries`
  std::uint32_t entries_per_count = 1;  ///< that one of the count stands for
};

struct LAMPLIGHT_API Plan {
  std::vector<BufferDesc> buffers;
  std::vector<Pass> passes;
  std::vector<FinerPasses> finer;  ///< the finest first; none where cells of any picture have one size
  LookUp lookup;
  std::optional<FusedLookUp> fused;
  std::uint64_t cells = 1;             ///< cells of the look-up
  bool ordered = true;                 ///< lists ascend
  bool approximate = false;            ///< may miss lights, by the paper's design
  bool any_depth = false;              ///< right for any depth of a pixel, not only the depth buffer's
  std::uint32_t width = 0;             ///< the problem's, pixels: of the largest frame
  std::uint32_t height = 0;            ///< likewise
  std::uint32_t views = 1;             ///< likewise
  std::uint32_t light_capacity = 0;    ///< likewise
  LightLayout light_layout;            ///< likewise
  std::uint32_t depth_samples = 1;     ///< likewise
  std::uint32_t frames_in_flight = 1;  ///< likewise
  ResourceId counters = NO_RESOURCE;   ///< buffer of counts that begins at zero, shared::Counters first; NO_RESOURCE if
                                       ///< nothing can overflow
  std::vector<Capacity> capacities;    ///< everything that can overflow
  std::vector<std::string> notes;  ///< what is done otherwise than the options ask, and why: the device lacks something

  /// Adds a buffer and returns its id.
  ResourceId add(BufferDesc buffer);
  /// Bytes from one view's part of a buffer to the next one's, where a descriptor or an element of any kind may begin.
  [[nodiscard]] std::uint64_t view_bytes(const BufferDesc& buffer) const;
  /// Of the parts of all views.
  [[nodiscard]] std::uint64_t all_bytes(const BufferDesc& buffer) const;
  /// Bytes that a buffer takes, with what it is filled from; of all buffers together.
  [[nodiscard]] std::uint64_t bytes_of(const BufferDesc& buffer) const;
  [[nodiscard]] std::uint64_t bytes() const;
  /// What the record of a frame of that size, in pixels, says (Frame::cell_shift), so that it takes no longer than with
  /// a plan for its size. 0 is right for every size.
  [[nodiscard]] std::uint32_t cell_shift(std::uint32_t frame_width, std::uint32_t frame_height) const;
  /// Whether a pass or a look-up, fused ones too, binds it.
  [[nodiscard]] bool binds(ResourceId id) const;
};

/// What the threads of a subgroup can do together, besides electing one of them, which all devices know.
struct SubgroupOperations {
  bool vote = false;
  bool ballot = false;
  bool arithmetic = false;
  bool shuffle = false;
  bool shuffle_relative = false;

  friend bool operator==(const SubgroupOperations&, const SubgroupOperations&) = default;
};
inline constexpr SubgroupOperations ALL_SUBGROUP_OPERATIONS{
    .vote = true, .ballot = true, .arithmetic = true, .shuffle = true, .shuffle_relative = true};

/// What plans and checks ask of a device. The defaults are the least that Vulkan 1.3 guarantees, but for storage
/// buffers and subgroups, which nearly all devices have more of.
struct DeviceTraits {
  std::uint64_t max_storage_buffer_bytes = 1ULL << 27;
  std::uint64_t memory_bytes = ~0ULL;  ///< of the largest heap of the device's own
  std::array<std::uint32_t, 3> max_groups{65535, 65535, 65535};
  std::uint32_t max_group_invocations = 128;  ///< not less
  std::uint32_t shared_memory_bytes = 16384;
  std::uint32_t max_image_size = 4096;     ///< pixels a side
  std::uint32_t max_storage_buffers = 16;  ///< that a shader stage sees; Vulkan guarantees 4, too few for most methods
  std::uint32_t storage_offset_alignment = 256;  ///< bytes, minStorageBufferOffsetAlignment; a power of two
  std::uint32_t subgroup_size = 32;              ///< threads, of most pipelines; a power of two
  std::uint32_t max_subgroup_size = 32;  ///< of any pipeline: some drivers choose for each; at least `subgroup_size`,
                                         ///< a power of two
  std::uint32_t max_loop_rounds = ~0U;   ///< of all loops of a thread together, > 0; llvmpipe ends them after 65 535
  SubgroupOperations compute_subgroups = ALL_SUBGROUP_OPERATIONS;   ///< in compute shaders; none are guaranteed
  SubgroupOperations fragment_subgroups = ALL_SUBGROUP_OPERATIONS;  ///< in fragment shaders; likewise
  std::uint32_t sub_pixel_bits = 4;  ///< triangles' corners are snapped to 1 / 2^that of a pixel; Vulkan guarantees 4;
                                     ///< at most 31
  bool conservative_raster = false;  ///< VK_EXT_conservative_rasterization is enabled
};

/// Everything about a plan that would fail on a device with these traits, found before there is one: traits that no
/// device has, a buffer beyond the limit (the light buffer that the plan reads included), all of them beyond the
/// memory, a binding to nothing, a read of what nothing wrote, too many groups or storage buffers, a host pass after a
/// GPU pass, a shader that does not exist or asks for subgroup operations that the device lacks, work groups that
/// subgroups cannot fill. The first such problem, or nothing.
[[nodiscard]] LAMPLIGHT_API std::optional<Error> plan_check(const Plan& plan, const DeviceTraits& traits);

}  // namespace lamp
