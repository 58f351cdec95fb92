// A captured frame on the GPU: it fills depth and G-buffer where other scenes draw their meshes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/transfer.h"
#include "render/targets.h"
#include "scene/captured_frame.h"

namespace lamp::app {

class CapturedSurfaces {
 public:
  CapturedSurfaces(Context& context, const CapturedFrame& frame);

  /// Copies all of it into targets of the frame's size.
  void record(vulkan::Recorder& recorder, const Targets& targets) const;

 private:
  vulkan::Buffer depth_;
  vulkan::Buffer base_color_;
  vulkan::Buffer surface_;
  vulkan::Buffer emission_;
};

}  // namespace lamp::app
