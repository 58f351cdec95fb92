// The oracle's place where it is too slow: the truth of every pixel on the GPU, and look-ups held against it.
// Based on: the contract of oracle/reference.h, which it repeats in double precision; tests hold it against that.
// Promise: shares no bounds and no cells with any method. Counts what the oracle counts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "render/renderer.h"
#include "render/shaders/reach_data.h"
#include "render/verification.h"

namespace lamp::app {

/// The truth about some rows of one frame. The renderer must outlive it and keep the frame.
class GpuVerifier {
 public:
  /// Makes the truth of the last frame's depth. `lights` are those of `Renderer::set_frame`. Throws Error where the
  /// device has no double precision, or no room.
  GpuVerifier(Renderer& renderer, std::span<const shared::Light> lights, Rows rows = {});
  ~GpuVerifier();
  GpuVerifier(const GpuVerifier&) = delete;
  GpuVerifier& operator=(const GpuVerifier&) = delete;

  /// Culls, walks every pixel's list, and compares. Of misses, the first is named by the oracle. `truth_sum` stays
  /// empty where lists miss or repeat lights, where the device ends a walk, where pixels of one cell walk different
  /// lists, or marks find no room. Pixels that miss lights come behind those of `misses`, if it is there.
  [[nodiscard]] Findings check(Lighting& lighting,
                               vulkan::PlanRunner::Passes which = vulkan::PlanRunner::Passes::separate,
                               std::vector<PixelMisses>* misses = nullptr);

 private:
  using Passes = vulkan::PlanRunner::Passes;
  /// Rows whose buffers are of a handy size, and their truth.
  struct Band {
    Rows rows;
    vulkan::Buffer truth;
  };
  class Cells;
  void make_truth(const Band& band);
  [[nodiscard]] std::vector<PixelPass::Storage> inputs() const;
  void walk(PixelPass pass, const Band& band);
  [[nodiscard]] std::vector<gpu::Survey> survey(Lighting& lighting, Passes which, const Band& band);
  /// Fills in what the surveys that were found leave open.
  void count_distinct(Lighting& lighting, Passes which, const Band& band, std::span<const gpu::Survey> found,
                      const vulkan::Buffer& surveys);
  [[nodiscard]] std::optional<std::uint64_t> count_cell_truth(Lighting& lighting, const Cells& cells);
  [[nodiscard]] std::string name_miss(Lighting& lighting, Passes which, std::uint32_t x, std::uint32_t y);

  Renderer& renderer_;
  std::span<const shared::Light> lights_;
  Rows rows_;
  vulkan::Buffer limits_;
  vulkan::Buffer world_from_view_;
  std::vector<Band> bands_;
};

}  // namespace lamp::app
