// Moves lights on the GPU along the paths of generated lights (scene/light_path.h), bit for bit as the CPU would.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "render/frame_data.h"
#include "render/shader_library.h"
#include "scene/light_path.h"

namespace lamp::app {

class LightMover {
 public:
  /// `lights` of a frame, of which from `first` on there is a path for each.
  LightMover(Context& context, const ShaderLibrary& shaders, std::span<const shared::Light> lights,
             std::span<const LightPath> paths, std::uint32_t first);

  /// Writes positions and spheres of the lights that `data` has uploaded.
  void record(vulkan::Recorder& recorder, const FrameData& data, const PathTime& time) const;
  [[nodiscard]] const vulkan::Buffer& buffer() const { return paths_; }

 private:
  std::uint32_t first_;
  std::uint32_t count_;
  vulkan::Buffer paths_;
  vulkan::Pipeline pipeline_;
};

}  // namespace lamp::app
