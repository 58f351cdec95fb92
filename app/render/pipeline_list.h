// Every pipeline that the methods, each value of their options and the shading paths need, compiled for one device.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lamplight/method.h"
#include "render/shader_library.h"

namespace lamp::app {

/// A pipeline, and who was the first to need it.
struct ListedPipeline {
  std::string method;  ///< empty: geometry, whatever the method
  std::string option;  ///< "tile=8", or empty: the method's defaults
  std::string use;     ///< of shading: "forward", "deferred, decals"; else empty, or for how many lights
  vulkan::Pipeline pipeline;
};

/// For pictures of 1920 x 1080 and 32 768 lights, and the passes of a million lights. First what the methods need with
/// their defaults, on every path; then what each value of each option (`sample_values`) needs besides. Values that do
/// not go with the defaults are left out. Throws Error when a pipeline cannot be made.
[[nodiscard]] std::vector<ListedPipeline> list_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders,
                                                         std::span<const Method> of);

}  // namespace lamp::app
