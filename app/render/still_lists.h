// Lists of lights that stand still, on the GPU: what shading looks them up with.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "gpu/context.h"
#include "lamplight/shared/triangle_lists.h"
#include "lamplight/vulkan.h"
#include "render/shaders/still_data.h"

namespace lamp::app {

/// Where shaders have them, and which way: constants and bindings of common/shade_still.glsl.
inline constexpr std::uint32_t CONSTANT_STILL = 19;
inline constexpr std::uint32_t BINDING_STILL = 14;

class StillLists {
 public:
  /// No list: all lights are the picture's.
  explicit StillLists(Context& context);
  /// `kind`: STILL_TRIANGLES or STILL_TREE. Throws Error where the device has no such buffer.
  StillLists(Context& context, std::uint32_t kind, std::uint32_t lights, std::span<const std::uint32_t> words);

  [[nodiscard]] std::uint32_t kind() const { return kind_; }
  [[nodiscard]] std::uint32_t lights() const { return lights_; }  ///< how many, the last of a frame's
  [[nodiscard]] const vulkan::Buffer& buffer() const { return words_; }
  [[nodiscard]] vulkan::Resource words() const { return vulkan::Resource::storage(words_.handle()); }

 private:
  std::uint32_t kind_ = gpu::STILL_OFF;
  std::uint32_t lights_ = 0;
  vulkan::Buffer words_;
};

}  // namespace lamp::app
