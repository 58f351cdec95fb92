// What an engine around a Culler has: a frame with its lights and depth, and a shader that walks the look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "gpu/dispatch.h"
#include "lamplight/view.h"

namespace lamp::app {

constexpr std::uint32_t ENGINE_WIDTH = 85;  // no multiple of any tile
constexpr std::uint32_t ENGINE_HEIGHT = 51;
constexpr std::uint32_t ENGINE_LIGHTS = 64;  ///< capacity: one bit a light in walk.comp

struct EngineFrame {
  View view;
  std::vector<shared::Light> lights;
  std::vector<float> depth;
  GpuImage depth_image;
  vulkan::Buffer light_buffer;
  vulkan::Buffer sphere_buffer;
};

struct EngineFrameInfo {
  std::string_view projection = "infinite";
  std::uint32_t lights = ENGINE_LIGHTS;
  std::uint32_t seed = 1;
  glm::dvec2 at{0.5, 0.5};  ///< where in a pixel the view has its centre; lights are the same
  bool reversed_depth = true;
};

/// The corridor as one projection shows it.
[[nodiscard]] EngineFrame engine_frame(const EngineFrameInfo& info = {});

/// All that a Culler may be told of it; which of it is read depends on the method.
[[nodiscard]] vulkan::CullerFrame culler_frame(const EngineFrame& frame);

/// For these frames.
[[nodiscard]] vulkan::CullerInfo engine_culler_info(std::string_view method, std::vector<std::string> options = {});

/// A Culler for these frames.
[[nodiscard]] Result<vulkan::Culler> engine_culler(std::string_view method, std::vector<std::string> options = {},
                                                   bool brings_spheres = false);

/// A pixel's lights, a bit each.
using Masks = std::vector<glm::uvec2>;

/// Asks the look-up for the lights of every pixel of a frame.
class MaskPass {
 public:
  /// `group_px`: of a fused look-up, its work group. `view`: which of several the frame is.
  MaskPass(const vulkan::BoundLookUp& lookup, const EngineFrame& frame, glm::uvec2 group_px = {8, 8},
           std::uint32_t view = 0);

  /// The dispatch alone: nothing is ordered before or after.
  void record(VkCommandBuffer commands, const vulkan::BoundLookUp& lookup) const;
  /// Makes what it wrote visible to the host.
  static void record_to_host(VkCommandBuffer commands);
  [[nodiscard]] Masks masks() const { return contents<glm::uvec2>(masks_); }

 private:
  const EngineFrame& frame_;
  glm::uvec2 group_px_;
  vulkan::Pipeline pipeline_;
  vulkan::Buffer frames_;
  vulkan::Buffer masks_;
  std::unique_ptr<vulkan::DescriptorSets> sets_;  ///< its own: other frames are recorded before it is done
};

/// Culls and walks in one command buffer. The engine orders nothing between the two: the Culler has done so.
[[nodiscard]] Masks cull_and_walk(vulkan::Culler& culler, const EngineFrame& frame);
/// Likewise, of a frame whose parts the Culler is told in another way.
[[nodiscard]] Masks cull_and_walk(vulkan::Culler& culler, const EngineFrame& frame, const vulkan::CullerFrame& told);

/// Every light that reaches a pixel, by the oracle, is in its mask.
void expect_no_miss(const EngineFrame& frame, const Masks& masks);

/// Lights of all pixels together.
[[nodiscard]] std::uint64_t walked(const Masks& masks);

}  // namespace lamp::app
