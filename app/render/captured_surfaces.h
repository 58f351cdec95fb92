// Surfaces that are there already, of a captured frame or of one that was drawn: they fill depth and G-buffer where
// else meshes are drawn.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "gpu/transfer.h"
#include "render/targets.h"
#include "scene/captured_frame.h"

namespace lamp::app {

class CapturedSurfaces {
 public:
  CapturedSurfaces(Context& context, const CapturedFrame& frame);
  /// With room for what targets of this size hold, until `record_keep` fills it.
  CapturedSurfaces(const vulkan::Device& device, const Targets& targets);

  /// Copies what targets hold, of the size given before.
  void record_keep(vulkan::Recorder& recorder, const Targets& targets) const;
  /// Copies all of it into targets of the frame's size.
  void record(vulkan::Recorder& recorder, const Targets& targets) const;

  [[nodiscard]] std::array<const vulkan::Buffer*, 4> buffers() const {
    return {&depth_, &base_color_, &surface_, &emission_};
  }

 private:
  vulkan::Buffer depth_;
  vulkan::Buffer base_color_;
  vulkan::Buffer surface_;
  vulkan::Buffer emission_;
};

}  // namespace lamp::app
