// What changes every frame, on the GPU: the cameras' records, the lights, and behind them the decals and the records of
// probes (entity.h).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gpu/context.h"
#include "lamplight/entity.h"
#include "lamplight/view.h"
#include "lamplight/vulkan.h"
#include "render/shaders/decal_data.h"
#include "render/shaders/probe_data.h"

namespace lamp::app {

class FrameData {
 public:
  /// `light_capacity`: probes included.
  FrameData(const vulkan::Device& device, std::uint32_t light_capacity, std::uint32_t decal_capacity = 0,
            std::uint32_t views = 1);

  /// Host side; the copies are recorded by the next `record_upload`.
  /// The last `still` lights are no entities of the picture: their records lie behind the probes'.
  void set(std::span<const View> views, std::span<const shared::Light> lights,
           std::span<const gpu::DecalData> decals = {}, std::uint32_t still = 0,
           std::span<const gpu::ProbeData> probes = {});
  /// The same entities, seen otherwise: by one view, in a place among a frame's.
  void set_view(const View& view, std::uint32_t index = 0);
  /// Cells of the views' sizes, where the plan has passes for smaller pictures.
  void take_cells_of(const Plan& plan);
  /// The entities of the picture: its lights, then the records of decals and probes.
  [[nodiscard]] std::span<const shared::Light> host_lights() const {
    return std::span(host_lights_).first(frame_of(0).light_count);
  }
  [[nodiscard]] const shared::Frame& host_frame() const { return frame_of(0); }
  /// m, of the views' eyes from the origin.
  [[nodiscard]] float farthest_eye_m() const;
  /// What was made ahead, for plans that read it (INPUT_STILL): at once, of no frame.
  void set_still(Context& context, std::span<const std::uint32_t> words);
  /// Nothing if it was recorded before, and nothing has been set since.
  void record_upload(vulkan::Recorder& recorder);

  [[nodiscard]] vulkan::Resource frame() const { return vulkan::Resource::storage(frame_.handle()); }
  /// The same as a uniform buffer: no instruction loads it on some GPUs.
  [[nodiscard]] vulkan::Resource frame_constants() const {
    return {.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, .buffer = frame_.handle()};
  }
  [[nodiscard]] vulkan::Resource lights() const { return vulkan::Resource::storage(lights_.handle()); }
  [[nodiscard]] vulkan::Resource spheres() const { return vulkan::Resource::storage(spheres_.handle()); }
  [[nodiscard]] vulkan::Resource decals() const { return vulkan::Resource::storage(decals_.handle()); }
  /// All records of lights, in their order; a box's lies where its number says, and is no light's.
  [[nodiscard]] std::span<const shared::Light> records() const { return host_lights_; }
  /// The ids of lights, decals and probes.
  [[nodiscard]] EntityRanges entities() const {
    const shared::Frame& frame = frame_of(0);
    return entity_ranges(frame.light_count - frame.box_count, frame.box_count - frame.probe_count, frame.probe_count);
  }
  /// `depths`: of each view one; they are kept by the caller.
  [[nodiscard]] vulkan::PlanInputs plan_inputs(std::span<const vulkan::Resource> depths) const;

 private:
  [[nodiscard]] const shared::Frame& frame_of(std::uint32_t view) const { return host_frames_[view]; }

  vulkan::Buffer frame_;
  vulkan::Buffer
      lights_;  ///< and a record for each decal and probe; then lights that stand still, in lists of their own
  vulkan::Buffer spheres_;  ///< of all these
  vulkan::Buffer decals_;
  vulkan::Buffer nothing_known_;  ///< radial bounds and meshes where no light casts a shadow
  vulkan::Buffer still_;          ///< none where nothing was made ahead
  vulkan::Buffer
      staging_;  ///< a shared::Frame of each view, then the lights with the decals' records, their spheres, the decals
  bool view_changed_ = true;  ///< since the last upload
  bool changed_ = true;       ///< anything else, likewise
  std::vector<shared::Frame> host_frames_;
  std::vector<shared::Light> host_lights_;  ///< all records
};

}  // namespace lamp::app
