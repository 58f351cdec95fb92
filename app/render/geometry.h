// The geometry passes: depth pre-pass, and the G-buffer, with the numbers of triangles where targets want them. A
// captured frame fills both at once, whichever is asked for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/host_depth.h"
#include "render/mesh_pass.h"

namespace lamp::app {

class Geometry {
 public:
  Geometry(const vulkan::Device& device, const ShaderLibrary& shaders, const HostDepth& depth = {});

  /// Before the first G-buffer of targets that are numbered.
  void need_triangles(const vulkan::Device& device, const ShaderLibrary& shaders);
  void record_depth(vulkan::Recorder& recorder, const GpuScene& scene, const FrameData& frame,
                    const Targets& targets) const;
  void record_gbuffer(vulkan::Recorder& recorder, const GpuScene& scene, const FrameData& frame,
                      const Targets& targets) const;

  [[nodiscard]] std::vector<vulkan::Pipeline> pipelines() const;

 private:
  HostDepth depth_;
  vulkan::Pipeline depth_opaque_;
  vulkan::Pipeline depth_masked_;
  vulkan::Pipeline gbuffer_;
  std::optional<vulkan::Pipeline> gbuffer_triangles_;  ///< once they are needed
};

}  // namespace lamp::app
