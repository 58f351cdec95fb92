// The lights that a look-up by position names at points of the world: on surfaces, in the air, behind the eye,
// anywhere.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/context.h"
#include "render/frame_data.h"
#include "render/shader_library.h"

namespace lamp::app {

/// What the walks of points named, in their order.
struct PointLights {
  std::vector<std::size_t> offsets{0};  ///< of each point's lights, and their end
  std::vector<std::uint32_t> lights;
  std::vector<std::uint32_t> ended;  ///< of each point: not 0 where the device ended the walk

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return std::span(lights).subspan(offsets[point], offsets[point + 1] - offsets[point]);
  }
};

/// A frame's lights, culled by a plan with a look-up by position.
class PointWalks {
 public:
  /// `still`: what the host made ahead, of plans that read it. Throws Error when the plan does not fit the device.
  PointWalks(Context& context, const ShaderLibrary& shaders, Plan plan, const View& view,
             std::span<const shared::Light> lights, std::span<const std::uint32_t> still = {});

  /// So many lights at most come back at once, unless a single point has more: what `walk` gives does not depend on it.
  void list_at_once(std::uint64_t lights) { listed_at_once_ = lights; }
  [[nodiscard]] PointLights walk(std::span<const glm::vec3> points);
  /// Of the last `walk`, with what the plan counted.
  [[nodiscard]] const vulkan::FrameCounts& counts() const { return counts_; }
  [[nodiscard]] const Plan& plan() const { return runner_.plan(); }
  /// Of the last `walk`, the first word of a buffer of the plan.
  [[nodiscard]] std::uint32_t word_of(std::string_view buffer);

 private:
  [[nodiscard]] vulkan::PlanInputs inputs() const;
  void walk_part(std::span<const glm::vec3> points, PointLights& to);
  void cull();
  void dispatch(const vulkan::Buffer& points, const vulkan::Buffer& lists, std::uint32_t count, bool writes);

  Context& context_;
  FrameData data_;
  vulkan::PlanRunner runner_;
  vulkan::Pipeline pipeline_;
  vulkan::AccessTracker tracker_;
  vulkan::Buffer words_;  ///< of a part's points: how many lights, or where their list begins
  vulkan::Buffer ended_;
  std::uint64_t listed_at_once_ = 1U << 25;  ///< 128 MiB, which storage buffers of every device hold
  vulkan::FrameCounts counts_;
};

}  // namespace lamp::app
