// What a picture is drawn into: depth, G-buffer, HDR.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gpu/image.h"
#include "lamplight/vulkan.h"

namespace lamp::app {

struct Targets {
  Targets(const vulkan::Device& device, std::uint32_t width, std::uint32_t height);

  std::uint32_t width;
  std::uint32_t height;
  GpuImage depth;         ///< D32
  GpuImage base_color;    ///< RGBA8 sRGB
  GpuImage surface;       ///< RG32 unsigned: normal; metallic, roughness, occlusion
  GpuImage emission;      ///< RGBA16F
  GpuImage triangles;     ///< R32 unsigned: the number of each pixel's triangle; not there until `need_triangles`
  GpuImage hdr;           ///< RGBA32F: pictures are compared bit for bit
  bool numbered = false;  ///< passes that draw the G-buffer draw `triangles` too

  /// Makes `triangles`, unless they are there.
  void need_triangles(const vulkan::Device& device);
};

/// Depth and G-buffer at the bindings of common/deferred_surface.glsl.
[[nodiscard]] std::vector<vulkan::Bound> gbuffer_bound(const Targets& targets);

/// Where deferred shading finds a pixel's triangle. Targets that are not numbered bind another image of whole numbers,
/// which nothing reads there.
inline constexpr std::uint32_t BINDING_TRIANGLES = 8;
[[nodiscard]] vulkan::Bound triangles_bound(const Targets& targets);

}  // namespace lamp::app
