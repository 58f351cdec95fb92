// Lists of lights that stand still, at the pixels that look them up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "commands/request.h"
#include "oracle/occluders.h"
#include "render/still_check.h"
#include "view/own_tests.h"

namespace lamp::app {

/// Lists, on the host and on the GPU. Lights have their numbers of the frame.
struct StillPixels {
  Context& context;
  const ShaderLibrary& shaders;
  const StillSetup& made;
  const StillLists& on_gpu;
  std::span<const shared::Light> lights;  ///< that stand still
  std::uint32_t first = 0;                ///< the first of them; all before are the picture's
  const Occluders* occluders = nullptr;   ///< null: lists leave out nothing that is hidden
  std::vector<gpu::StillPoint> points;    ///< of all pixels, row by row

  [[nodiscard]] bool has(std::size_t pixel) const { return made.tree || points[pixel].triangle != NO_TRIANGLE; }
  /// The list of a pixel that shows a surface, ascending.
  [[nodiscard]] std::vector<std::uint32_t> lights_at(std::size_t pixel) const;
  /// Holds the lists of pixels that show surfaces against the oracle.
  [[nodiscard]] StillFindings check(std::span<const std::size_t> pixels) const;
  /// What they go by.
  [[nodiscard]] OwnTests tests() const {
    return {.passes = 0, .otherwise = made.tree ? "its cell of the still lights' tree" : "its triangle's list"};
  }
};

}  // namespace lamp::app
