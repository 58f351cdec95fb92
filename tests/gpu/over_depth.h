// A plan, run over a depth buffer that nothing has drawn, and a test shader over its look-up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gpu/dispatch.h"
#include "lamplight/view.h"
#include "render/frame_data.h"

namespace lamp::app {

class OverDepth {
 public:
  /// `depth`: device depths of all the view's pixels, row by row.
  OverDepth(const View& view, const std::vector<float>& depth, const std::vector<shared::Light>& lights);
  /// Of an image that is larger than the picture.
  OverDepth(const View& view, GpuImage depth, const std::vector<shared::Light>& lights);

  /// What was made ahead, for plans that read it.
  void set_still(std::span<const std::uint32_t> words) { data_.set_still(test_context(), words); }

  /// Records the plan, then `shader`, compiled against the plan's look-up: 0 is the frame, 1 a word for each pixel,
  /// which it writes and this returns.
  [[nodiscard]] std::vector<std::uint32_t> per_pixel(const std::string& shader, vulkan::PlanRunner& runner,
                                                     vulkan::PlanRunner::Passes which);
  /// The same for several shaders over one result, which write so many words for each pixel.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> per_pixel(const std::vector<std::string>& shaders,
                                                                  vulkan::PlanRunner& runner,
                                                                  vulkan::PlanRunner::Passes which,
                                                                  std::uint32_t words);

 private:
  glm::uvec2 size_;
  GpuImage depth_;
  FrameData data_;
};

}  // namespace lamp::app
