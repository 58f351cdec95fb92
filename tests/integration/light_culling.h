// Where the engine meets Lamplight: a Culler and the pipeline that reads its look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <lamplight/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine.h"

struct LightCullingInfo {
  std::string method;
  std::vector<std::string> options;      ///< "tile=32"
  std::string lookup;                    ///< the file below lookup/ that the shader includes
  std::span<const std::uint32_t> spirv;  ///< the counting shader
  std::uint32_t set = 0;                 ///< where it has put its bindings and the look-up's
  std::uint32_t first_binding = lamp::LOOKUP_BINDING;
  std::uint32_t first_constant = lamp::LOOKUP_CONSTANT;
  VkExtent2D size{};
  std::uint32_t light_capacity = 0;
};

/// Culls the lights of one picture size with one method, and counts through the engine's own shader.
class LightCulling {
 public:
  LightCulling(Engine& engine, const LightCullingInfo& info);

  struct Frame {
    const lamp::View& view;
    VkBuffer lights;  ///< lamp::shared::Light[light_count]
    std::uint32_t light_count;
    const DepthImage& depth;
    VkBuffer counts;  ///< the counting shader writes reached and walked lights, 8 bytes a pixel
  };
  /// Lights and depth must be visible to compute shaders; the counts are then written by a compute shader.
  void record(VkCommandBuffer commands, const Frame& frame);

  /// After the fence of the frame that was recorded last: makes room for the next one where lists did not fit. Returns
  /// whether it did.
  bool finish();

  /// Cells whose lists did not fit in the last finished frame.
  [[nodiscard]] std::uint32_t overflowed_cells() const { return culler_.counters().overflowed_cells; }
  [[nodiscard]] std::uint64_t bytes() const { return culler_.bytes(); }

 private:
  void make_pipeline();

  Engine& engine_;
  LightCullingInfo info_;
  lamp::vulkan::Culler culler_;
  std::uint64_t frame_ = 0;  ///< recorded last
  ComputePipeline count_;
};
